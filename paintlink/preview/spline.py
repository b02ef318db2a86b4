"""Cubic splines of the aspecular angle, with the corner a measured curve may have."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import FloatArray

DEGREE = 3
END_DEG = 110.0
CORNER_DEG = 15.0
KNOTS_DEG = np.array(
    [0.0] * 4
    + [CORNER_DEG] * 3
    + [24.0, 27.0, 33.0, 41.0, 49.0, 60.0, 73.0, 83.0]
    + [END_DEG] * 4
)
"""Threefold where the face of a paint meets its measured body: the slope may jump.

The others lie where the error over effect and real paints was found to be least.
"""

SPLINES = len(KNOTS_DEG) - DEGREE - 1


def splines(angles_deg: ArrayLike) -> FloatArray:
    """Every B-spline at the angles held at 110 degrees, shape (n, SPLINES).

    They are never negative and sum to 1.

    References
    ----------
    de Boor, A Practical Guide to Splines (1978), the recurrence X(4).
    """
    angles = np.clip(np.asarray(angles_deg, dtype=np.float64), 0.0, END_DEG)[:, None]
    last = np.searchsorted(KNOTS_DEG, END_DEG) - 1
    spans = np.arange(len(KNOTS_DEG) - 1)
    within = (KNOTS_DEG[:-1] <= angles) & (angles < KNOTS_DEG[1:])
    ending = (angles == END_DEG) & (spans == last)
    values: FloatArray = (within | ending).astype(np.float64)
    for degree in range(1, DEGREE + 1):
        values = _raised(values, angles, degree)
    return values


def _raised(values: FloatArray, angles: FloatArray, degree: int) -> FloatArray:
    """Splines of one degree more, one function fewer."""
    first, last = KNOTS_DEG[: -degree - 1], KNOTS_DEG[degree + 1 :]
    rising = _share(angles - first, KNOTS_DEG[degree:-1] - first)
    falling = _share(last - angles, last - KNOTS_DEG[1:-degree])
    return rising * values[:, :-1] + falling * values[:, 1:]


def _share(part: FloatArray, whole: FloatArray) -> FloatArray:
    """Quotient, 0 where knots fall together."""
    share: FloatArray = np.where(whole > 0.0, part / np.where(whole > 0.0, whole, 1), 0)
    return share
