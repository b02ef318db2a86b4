"""What a renderer gives back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from paintlink import __version__
from paintlink.color.display import encode_srgb, into_gamut
from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview.arrays import Float32Array
from paintlink.spec import spec_id

Backend = Literal["auto", "gl", "cpu"]

WARNING = "not for visual matching"


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A drawn paint, or several side by side, with how it came about.

    Parameters
    ----------
    rgb
        Encoded sRGB, shape (height, width, 3), top row first; read-only.
    backend
        What drew it: ``gl`` or ``cpu``.
    reason
        Which renderer that is, or why it was not OpenGL.
    setting
        Object and light in words for people.
    flags
        How many covered pixels there are of each sum of `cpu.TOO_CHROMATIC` and
        `cpu.TOO_BRIGHT`.
    linear
        Light before it is brought into sRGB, shape (height, width, 3), 1 being the
        perfect diffuser; only where it was asked for, and without a caption.
    notes
        What had to be assumed, in words for people.
    """

    rgb: NDArray[np.uint8]
    backend: Literal["gl", "cpu"]
    reason: str
    object: str
    light: str
    specs: tuple[ColorSpec, ...]
    setting: str = ""
    flags: tuple[int, ...] = (0, 0, 0, 0)
    notes: tuple[str, ...] = ()
    linear: Float32Array | None = None

    def __post_init__(self) -> None:
        self.rgb.setflags(write=False)

    @property
    def too_chromatic(self) -> float:
        """Share of the object that sRGB has no chroma for, 0 to 1."""
        return (self.flags[1] + self.flags[3]) / max(sum(self.flags), 1)

    @property
    def too_bright(self) -> float:
        """Share of the object brighter than the screen, shown darker, 0 to 1."""
        return (self.flags[2] + self.flags[3]) / max(sum(self.flags), 1)

    def deep_rgb(self) -> NDArray[np.uint16]:
        """Encoded sRGB with 16 bits, shape (height, width, 3).

        Raises
        ------
        PreviewError
            When the picture does not keep its linear light.
        """
        shown = encode_srgb(into_gamut(self.required_linear()))
        return np.rint(65535.0 * shown).astype(np.uint16)

    def required_linear(self) -> Float32Array:
        """``linear``; errors are those of `deep_rgb`."""
        if self.linear is None:
            msg = "this picture keeps 8 bits only: draw it with linear=True"
            raise PreviewError(msg)
        return self.linear


def facts(picture: Picture) -> dict[str, Any]:
    """What a picture shows and how it came about, for programs."""
    return {
        "paints": [
            {"id": spec_id(spec), "name": spec.name, "code": spec.code}
            for spec in picture.specs
        ],
        "object": picture.object,
        "light": picture.light,
        "width": picture.rgb.shape[1],
        "height": picture.rgb.shape[0],
        "renderer": f"{picture.backend}: {picture.reason}",
        "too_chromatic": round(picture.too_chromatic, 6),
        "too_bright": round(picture.too_bright, 6),
        "notes": [*picture.notes, WARNING],
        "version": __version__,
    }
