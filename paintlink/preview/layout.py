"""Several paints on one object: which pixel shows which."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

Pattern = Literal["columns", "stripes", "checker"]

MOST = 4
"""Paints on one object."""

SEAM_SHARE = 1 / 200
STRIPES_EACH = 3
SQUARES_ACROSS = 8


class Parts(NamedTuple):
    """Which paint each pixel shows, (n,), and how much of it the gaps leave, (n,)."""

    number: NDArray[np.uint8]
    share: Float32Array


@dataclass(frozen=True)
class Layout:
    """How ``count`` paints share an object.

    Parameters
    ----------
    pattern
        ``columns`` from left to right, ``stripes`` that alternate, or a ``checker``.
    """

    pattern: Pattern
    count: int

    def parts(
        self, span: tuple[float, float], column: FloatArray, row: FloatArray, size: int
    ) -> Parts:
        """What pixels show.

        Parameters
        ----------
        span
            Left and right end of the object, -1 to 1.
        column, row
            Of each pixel, shape (n,).
        size
            Of the picture in pixels.
        """
        if self.count == 1:
            whole = np.ones(len(column), dtype=np.float32)
            return Parts(np.zeros(len(column), dtype=np.uint8), whole)
        left, right = ((end + 1.0) / 2.0 * size for end in span)
        half_seam = max(0.5, size * SEAM_SHARE / 2.0)
        if self.pattern == "checker":
            side = (right - left) / SQUARES_ACROSS
            across, beside = _cells(column + 0.5 - left, side)
            down, below = _cells(row + 0.5 - left, side)
            gap = np.minimum(beside, below)
            number = self._square(across, down)
        else:
            cells = self.count * (1 if self.pattern == "columns" else STRIPES_EACH)
            across, gap = _cells(column + 0.5 - left, (right - left) / cells, cells)
            number = across % self.count
        share = np.clip(gap - half_seam + 0.5, 0.0, 1.0).astype(np.float32)
        return Parts(number.astype(np.uint8), share)

    def _square(self, across: FloatArray, down: FloatArray) -> FloatArray:
        if self.count == MOST:
            return across % 2 + 2.0 * (down % 2)
        return (across + down) % self.count


def _cells(
    place: FloatArray, side: float, most: int | None = None
) -> tuple[FloatArray, FloatArray]:
    """Number of the cell each place is in, and its distance to the next seam."""
    number = np.floor(place / side)
    if most is None:
        seam = np.round(place / side)
    else:
        number = np.clip(number, 0, most - 1)
        seam = np.clip(np.round(place / side), 1, most - 1)
    return number, np.abs(place - seam * side)


ALONE = Layout("columns", 1)
