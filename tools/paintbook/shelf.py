"""The paints taken so far, and whether another one has room beside them."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray

LIGHTNESS_45 = 3


class Shelf:
    """Lab at 15, 45 and 110 degrees of the paints taken."""

    def __init__(self, size: int) -> None:
        self._taken = np.empty((9, size))
        self._count = 0

    def room(self, travel: FloatArray, spacing: float) -> bool:
        """Whether each paint taken differs by this in at least one of nine values."""
        values = travel.ravel()
        # Few paints are as light at 45 degrees; only these need a closer look.
        lightness = self._taken[LIGHTNESS_45, : self._count]
        near = np.flatnonzero(np.abs(lightness - values[LIGHTNESS_45]) < spacing)
        if not near.size:
            return True
        away = np.abs(self._taken[:, near] - values[:, np.newaxis])
        return bool((away >= spacing).any(axis=0).all())

    def put(self, travel: FloatArray) -> None:
        """Take a paint."""
        self._taken[:, self._count] = travel.ravel()
        self._count += 1
