"""How far a colour lies outside the colours of a library."""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from paintlink.model import FloatArray, PaintTable

DIRECTIONS = 600
BLOCK_PAINTS = 100_000

_EXTENTS: WeakKeyDictionary[PaintTable, dict[float, FloatArray]] = WeakKeyDictionary()


def outside(table: PaintTable, angle_deg: float, lab: FloatArray) -> float:
    """Lab units by which a colour lies beyond the convex hull of a library, at least.

    0 inside. The hull is held against `DIRECTIONS` directions spread evenly over the
    sphere: a colour is outside by at least as much as it reaches farther than every
    paint in one of them. The largest of these falls short of the distance by less
    than 1 % where the hull is flat, by more at its corners.

    Parameters
    ----------
    angle_deg
        One of the table's aspecular angles.
    lab
        Shape (3,).
    """
    extents = _EXTENTS.setdefault(table, {})
    if angle_deg not in extents:
        extents[angle_deg] = _extent(table, angle_deg)
    return max(float((_directions() @ lab - extents[angle_deg]).max()), 0.0)


def _extent(table: PaintTable, angle_deg: float) -> FloatArray:
    """How far the library reaches in each direction; paints without Lab left out."""
    lab = table.lab[:, table.angles_deg.index(angle_deg)]
    directions, reach = _directions(), np.full(DIRECTIONS, -np.inf)
    for start in range(0, len(lab), BLOCK_PAINTS):
        block = lab[start : start + BLOCK_PAINTS] @ directions.T
        reach = np.fmax(reach, np.fmax.reduce(block, axis=0))
    return reach


def _directions() -> FloatArray:
    """Unit vectors on a spiral from pole to pole, shape (DIRECTIONS, 3)."""
    step = np.arange(DIRECTIONS) + 0.5
    z = 1.0 - 2.0 * step / DIRECTIONS
    turn = np.pi * (1.0 + np.sqrt(5.0)) * step
    r = np.sqrt(1.0 - z * z)
    return np.stack([z, r * np.cos(turn), r * np.sin(turn)], axis=1)
