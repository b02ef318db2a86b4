"""What a camera sees of an object in some rows of a picture."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.preview.view import View

SAMPLES_ACROSS = 1024


@dataclass(frozen=True, eq=False)
class Surface:
    """The covered pixels of a band, each with one or more samples of the surface.

    Parameters
    ----------
    view
        Direction of the middle of the picture; ``normals`` are as seen from there.
    pixels
        Positions in the band of n covered pixels, ascending.
    cover
        Share of each that the object covers, shape (n,).
    first
        Where the samples of each pixel begin, shape (n,).
    normals
        Unit normals of m samples, shape (m, 3).
    towards
        Unit directions from the samples to the camera, shape (m, 3), where they differ
        from (0, 0, 1).
    lit
        Share of the light that nothing hides, shape (n,).
    behind
        Linear grey behind and around the object, shape (rows, columns).
    """

    view: View
    pixels: NDArray[np.intp]
    cover: Float32Array
    first: NDArray[np.intp]
    normals: Float32Array
    towards: Float32Array | None
    lit: Float32Array
    behind: FloatArray

    def samples_of(self, some: slice) -> slice:
        """The samples of a run of pixels."""
        ends = np.append(self.first, len(self.normals))
        return slice(int(ends[some.start]), int(ends[some.stop]))


def samples_across(size: int) -> int:
    """How many samples a pixel is wide: fewer in large pictures, 1 to 4."""
    return int(np.clip(round(SAMPLES_ACROSS / size), 1, 4))


def pixel_centres(size: int, rows: slice) -> tuple[FloatArray, FloatArray]:
    """Places of the pixels, x to the right and y up, both from -1 to 1."""
    column = (2.0 * np.arange(size) + 1.0) / size - 1.0
    row = 1.0 - (2.0 * np.arange(rows.start, rows.stop) + 1.0) / size
    x, y = np.meshgrid(column, row)
    return x, y
