"""How the file of a painting kept its pixels, so that a fit can be kept the same way.

Eight bits a channel round; a JPEG rounds colour differences over blocks. What that
does to a known picture is found by doing it again.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from paintlink.model import FloatArray
from paintlink.sketch.profiles import Profile

TOP = 255.0


class Storage(Protocol):
    """What becomes of encoded sRGB when it is saved and read again."""

    @property
    def spreads(self) -> bool:
        """Whether a pixel's neighbours change what becomes of it."""
        ...

    def again(self, encoded: FloatArray) -> FloatArray:
        """The picture, shape (height, width, 3), as the file would give it back."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Rounded:
    """Eight bits a channel, in sRGB or in the space of an embedded profile."""

    profile: Profile | None = None
    spreads: bool = field(default=False, init=False)

    def again(self, encoded: FloatArray) -> FloatArray:
        """Encoded sRGB after rounding to whole codes."""
        if self.profile is None:
            return np.rint(encoded * TOP) / TOP
        codes = np.rint(self.profile.from_srgb(encoded) * TOP) / TOP
        return np.clip(self.profile.convert(codes), 0.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Compressed:
    """A JPEG with its own tables.

    Parameters
    ----------
    tables
        Quantisation tables by their number, 64 values each.
    subsampling
        Pillow's number of the chroma subsampling: 0 none, 1 across, 2 both ways.
    profile
        Of the space it was saved in; None for sRGB.
    """

    tables: Mapping[int, list[int]]
    subsampling: int
    profile: Profile | None = None
    spreads: bool = field(default=True, init=False)

    def again(self, encoded: FloatArray) -> FloatArray:
        """Encoded sRGB after one more round of compression with the same tables."""
        from PIL import Image

        values = encoded if self.profile is None else self.profile.from_srgb(encoded)
        codes = np.rint(np.clip(values, 0.0, 1.0) * TOP).astype(np.uint8)
        file = io.BytesIO()
        Image.fromarray(codes).save(
            file, "JPEG", qtables=dict(self.tables), subsampling=self.subsampling
        )
        with Image.open(file) as image:
            back = np.asarray(image.convert("RGB")) / TOP
        if self.profile is None:
            return back
        return np.clip(self.profile.convert(back), 0.0, 1.0)
