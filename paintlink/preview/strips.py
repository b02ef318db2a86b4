"""Several paints side by side on one object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.preview.arrays import Float32Array

SEAM_SHARE = 1 / 200
MOST = 4


@dataclass(frozen=True, eq=False)
class Strips:
    """Vertical strips of the picture, one for each paint, from left to right.

    Parameters
    ----------
    inks
        What to multiply the light of each term with, shape (strips, terms, 3).
    edges
        Columns where strips begin, and the width: strips + 1 numbers.
    """

    inks: Float32Array
    edges: tuple[int, ...]

    @property
    def half_seam(self) -> float:
        """Half the width in pixels of the gap between two strips."""
        return max(0.5, self.edges[-1] * SEAM_SHARE / 2.0)

    def between_seams(self) -> Float32Array:
        """Share of each column a strip covers, shape (width,)."""
        middle = np.arange(self.edges[-1]) + 0.5
        share = np.ones(self.edges[-1])
        for edge in self.edges[1:-1]:
            beyond = np.abs(middle - edge) - self.half_seam + 0.5
            share *= np.clip(beyond, 0.0, 1.0)
        return share.astype(np.float32)


def split(span: tuple[float, float], count: int, width: int) -> tuple[int, ...]:
    """Edges of ``count`` equal strips of an object that spans ``span`` of -1 to 1."""
    inner = np.linspace(*span, count + 1)[1:-1]
    return (0, *(round((x + 1.0) / 2.0 * width) for x in inner), width)
