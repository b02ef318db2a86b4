"""Comparing every paint: the definition the tree is held to, and its last step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.snap.conditions import Comparison

Positions = NDArray[np.int64]

BLOCK_PAINTS = 16_384
"""Paints compared at a time; more fall out of the processor's cache."""

NEAR_TIE = (1e-9, 1e-9)
"""Relative and absolute reach beyond the last total, within which screening by other
arithmetic could have changed the order."""

MOST_TOTAL = float(np.finfo(np.float64).max)


class Ranked(NamedTuple):
    """Paints in order, with totals (k,) and differences (k, angles).

    ``compared`` counts the paints that were compared to find them.
    """

    positions: Positions
    totals: FloatArray
    differences: FloatArray
    compared: int


def differences(planes: FloatArray, comparison: Comparison) -> FloatArray:
    """Difference of the target from each paint at each angle, shape (angles, n).

    The paint is the standard, the target the sample.

    Parameters
    ----------
    planes
        Lab of the paints, shape (angles, 3, n).
    """
    return comparison.formula(
        planes.transpose(0, 2, 1),
        comparison.target[:, np.newaxis],
        np.array(comparison.angles_deg)[:, np.newaxis],
    )


def total(at_angles: FloatArray) -> FloatArray:
    """Sum over the angles, shape (n,), of differences (angles, n).

    Starts at 0.0 and takes one angle after the other: the order settles the last
    bit, and with it near ties.
    """
    summed = np.zeros(at_angles.shape[1:])
    for at_angle in at_angles:
        summed += at_angle
    return summed


def totals(planes: FloatArray, comparison: Comparison) -> FloatArray:
    """Total difference of the target from each paint, shape (n,)."""
    blocks = (
        total(differences(planes[..., start : start + BLOCK_PAINTS], comparison))
        for start in range(0, planes.shape[2], BLOCK_PAINTS)
    )
    return np.concatenate([np.empty(0), *blocks])


def shortlist(screened: FloatArray, count: int) -> tuple[Positions, float]:
    """Positions that may belong to the ``count`` smallest, and the last one's total.

    Paints that cannot be compared (NaN) are not among them.
    """
    limit = np.inf
    if screened.size > count:
        limit = float(np.partition(screened, count - 1)[count - 1])
    return (screened <= reach(limit)).nonzero()[0], limit


def reach(limit: float) -> float:
    """Up to which screened total a paint may still be as near as the limit says."""
    relative, absolute = NEAR_TIE
    return min(limit * (1.0 + relative) + absolute, MOST_TOTAL)


def rank(
    paints: FloatArray, ids: NDArray[np.int64], comparison: Comparison, count: int
) -> tuple[Positions, FloatArray, FloatArray]:
    """Order, totals and differences of the first ``count`` of some paints.

    By total, ties by the smaller id. Every list, however it was screened, ends here,
    so that totals have the same bits.

    Parameters
    ----------
    paints
        Lab of shape (angles, 3, n).
    """
    at_angles = differences(np.ascontiguousarray(paints), comparison)
    summed = total(at_angles)
    order = np.lexsort((ids, summed))[:count]
    return order, summed[order], at_angles[:, order].T
