"""What passes between setting up a sketch, reading it back and fitting a paint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.sketch.storage import Storage

BoolArray = NDArray[np.bool_]
PixelArray = NDArray[np.floating]
"""One number a pixel, single precision where the picture is large; sums need double."""


@dataclass(frozen=True, slots=True, eq=False)
class PixelGeometry:
    """Where each pixel looks: what the reflection of a paint depends on.

    Parameters
    ----------
    theta_deg
        Aspecular angle, unsigned, 0 to 180 degrees, shape (height, width).
    phi
        Cosine between the light and the surface normal, shape (height, width).
    mask
        Pixels that show lit paint, shape (height, width).
    """

    theta_deg: PixelArray
    phi: PixelArray
    mask: BoolArray

    def rows(self, chosen: NDArray[np.int64]) -> PixelGeometry:
        """The geometry of some rows."""
        return PixelGeometry(
            self.theta_deg[chosen], self.phi[chosen], self.mask[chosen]
        )


@dataclass(frozen=True, slots=True, eq=False)
class Painting:
    """A picture as it was read: sRGB, still encoded (gamma), in the recipe's frame.

    Parameters
    ----------
    encoded
        Red, green, blue, 0 to 1, shape (height, width, 3).
    alpha
        Opacity 0 to 1, shape (height, width); None where the file has none.
    bits
        Depth of the file, 8 or 16 a channel.
    notes
        What a reader should know: profile converted, palette, moved.
    lossy
        Whether the file was compressed with loss.
    storage
        What saving did to the pixels; None where that is too fine to matter, or not
        known.
    """

    encoded: PixelArray
    alpha: PixelArray | None = None
    bits: int = 8
    notes: tuple[str, ...] = ()
    lossy: bool = False
    storage: Storage | None = None
