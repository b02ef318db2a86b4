"""Boxes of colours: ranges of L, a and b at each angle."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.floating[Any]]


class Box(NamedTuple):
    """Lowest and highest coordinates, shape (angles, 3, ...)."""

    low: Numbers
    high: Numbers


def gap(q: Numbers, box: Box) -> Numbers:
    """Distance of q from each range, 0 inside."""
    below = box.low - q
    np.maximum(below, q - box.high, out=below)
    return np.maximum(below, 0.0, out=below)


def plane_distance2(q: Numbers, box: Box) -> Numbers:
    """Squared distance from the target to the rectangle in a and b."""
    a, b = ab_gaps(q, box)
    return a * a + b * b


def ab_gaps(q: Numbers, box: Box) -> tuple[Numbers, Numbers]:
    """Distance of the target from the ranges of a and of b."""
    gaps = gap(q[:, 1:], Box(box.low[:, 1:], box.high[:, 1:]))
    return gaps[:, 0], gaps[:, 1]


def neutral_corners(box: Box) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """|a| and |b| nearest to the neutral axis, then farthest from it."""
    low = np.asarray(box.low[:, 1:], dtype=np.float64)
    high = np.asarray(box.high[:, 1:], dtype=np.float64)
    nearest = np.maximum(np.maximum(low, -high), 0.0)
    farthest = np.maximum(np.abs(low), np.abs(high))
    return nearest[:, 0], nearest[:, 1], farthest[:, 0], farthest[:, 1]


def chroma_range(box: Box) -> tuple[Numbers, Numbers]:
    """Smallest and largest chroma in the box."""
    n_a, n_b, f_a, f_b = neutral_corners(box)
    return np.sqrt(n_a * n_a + n_b * n_b), np.sqrt(f_a * f_a + f_b * f_b)
