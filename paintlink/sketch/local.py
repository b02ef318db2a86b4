"""Lab at a wanted aspecular angle by a regression over its surroundings only."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells

HELD_FROM_DEG = 110.0
"""Paints are taken as constant from here on, so pixels beyond support the value."""

WINDOW_ANGLES_DEG = (15.0, 25.0, 45.0, 75.0, 110.0)
WINDOW_HALF_WIDTHS_DEG = (9.0, 10.0, 10.0, 8.0, 22.0)

SPREAD_FACTOR = 1.25
"""The sandwich comes out a fifth too small on pictures with known noise."""

QUANTISED_LAB = 0.05
LOSSY_LAB = 0.15


class LocalValue(NamedTuple):
    """Lab at an angle and one standard deviation of each channel, shape (3,)."""

    lab: FloatArray
    uncertainty: FloatArray


def half_width_deg(angle_deg: float) -> float:
    """Half width of the window of a wanted angle, wider where paints change slowly."""
    return float(np.interp(angle_deg, WINDOW_ANGLES_DEG, WINDOW_HALF_WIDTHS_DEG))


def local_value(cells: Cells, angle_deg: float, *, lossy: bool = False) -> LocalValue:
    """Constant term of a weighted quadratic about the angle.

    The uncertainty is a sandwich estimate, each residual divided by one minus its
    leverage; what quantisation and compression do to all pixels alike is added.
    """
    h = half_width_deg(angle_deg)
    near = np.abs(cells.theta_deg - angle_deg) < h
    theta, lab = cells.theta_deg[near], cells.lab[near]
    x = (np.minimum(theta, HELD_FROM_DEG) - angle_deg) / h
    weight = cells.weight[near] * (1.0 - ((theta - angle_deg) / h) ** 2)
    root = np.sqrt(weight)
    design = np.vander(x, 3, increasing=True)
    hat = np.linalg.pinv(root[:, np.newaxis] * design) * root
    coefficients = hat @ lab
    left = np.maximum(1.0 - np.einsum("ij,ji->i", design, hat), 0.1)
    pull = (hat[0] / left)[:, np.newaxis] * (lab - design @ coefficients)
    spread = SPREAD_FACTOR * np.sqrt((pull * pull).sum(axis=0))
    value = coefficients[0]
    value[0] = max(value[0], 0.0)
    return LocalValue(value, np.hypot(spread, LOSSY_LAB if lossy else QUANTISED_LAB))
