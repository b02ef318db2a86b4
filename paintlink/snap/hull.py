"""How far a colour lies outside the colours of a library."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray, PaintTable

CLOSE = 1e-6
"""Squared Lab units that further steps could gain; less is not worth a step."""

MOST_STEPS = 200


def outside(table: PaintTable, angle_deg: float, lab: FloatArray) -> float:
    """Lab units from a colour to the convex hull of a library's colours, 0 inside.

    Parameters
    ----------
    angle_deg
        One of the table's aspecular angles.
    lab
        Shape (3,).

    Notes
    -----
    The point of a polytope nearest to the origin, found over at most four of its
    corners at a time.

    References
    ----------
    Wolfe: Finding the nearest point in a polytope, Mathematical Programming 11 (1976).
    """
    paints = table.lab[:, table.angles_deg.index(angle_deg)]
    L, a, b = (paints[:, channel] - lab[channel] for channel in range(3))
    corners = [int(np.nanargmin(L * L + a * a + b * b))]
    weights = np.ones(1)
    for _ in range(MOST_STEPS):
        points = np.array([(L[i], a[i], b[i]) for i in corners])
        corners, weights = _nearest_of(points, weights, corners)
        points = np.array([(L[i], a[i], b[i]) for i in corners])
        nearest = weights @ points
        ahead = nearest[0] * L + nearest[1] * a + nearest[2] * b
        best = int(np.nanargmin(ahead))
        if best in corners or nearest @ nearest - ahead[best] <= CLOSE:
            break
        corners, weights = [*corners, best], np.append(weights, 0.0)
    squared = float(nearest @ nearest)
    return float(np.sqrt(squared)) if squared > CLOSE else 0.0


def _nearest_of(
    points: FloatArray, weights: FloatArray, corners: list[int]
) -> tuple[list[int], FloatArray]:
    """The corners that span the nearest point to the origin, and their weights.

    Points that would need a negative weight are dropped one after the other.
    """
    while len(corners) > 1:
        wanted = _affine(points)
        if wanted.min() > 0.0:
            return corners, wanted
        falling = wanted < weights
        share = weights[falling] / (weights[falling] - wanted[falling])
        weights = weights + min(float(share.min()), 1.0) * (wanted - weights)
        kept = weights > 1e-12
        kept[np.argmin(weights)] = False
        points, weights = points[kept], weights[kept] / weights[kept].sum()
        corners = [one for one, keep in zip(corners, kept, strict=True) if keep]
    return corners, np.ones(1)


def _affine(points: FloatArray) -> FloatArray:
    """Weights with sum 1 that bring points (k, 3) nearest to the origin."""
    count = len(points)
    system = np.ones((count + 1, count + 1))
    system[0, 0] = 0.0
    system[1:, 1:] = points @ points.T
    wanted = np.zeros(count + 1)
    wanted[0] = 1.0
    solution = np.linalg.lstsq(system, wanted, rcond=None)[0]
    return np.asarray(solution[1:], dtype=np.float64)
