"""The search itself: every paint is compared.

A tree that skips paints may take its place; it has to find the same paints, because
both are held to one order: by the total, then by the stable id.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.snap.conditions import Comparison


def totals(paints: Sequence[FloatArray], comparison: Comparison) -> FloatArray:
    """Difference of the target from each paint, summed over the angles, shape (n,).

    The paint is the standard, the target the sample. The sum starts at 0.0 and takes
    one angle after the other: the order settles the last bit, and with it near ties.

    Parameters
    ----------
    paints
        Lab of the paints, one array of shape (n, 3) for each angle.
    """
    total = np.zeros(len(paints[0]))
    sides = zip(paints, comparison.target, comparison.angles_deg, strict=True)
    for paint, target, angle in sides:
        total += comparison.formula(paint, target, angle)
    return total


def first(total: FloatArray, ids: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Positions of the smallest totals, at most ``count``; ties by the smaller id."""
    count = min(count, total.size)
    limit = np.partition(total, count - 1)[count - 1]
    candidates = np.flatnonzero(total <= limit)
    order = np.lexsort((ids[candidates], total[candidates]))
    return candidates[order[:count]]
