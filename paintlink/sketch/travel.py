"""The clamped quadratic in Lab through the cells of a sketch, for drawing beside it."""

from __future__ import annotations

import numpy as np

from paintlink.color import Curve
from paintlink.color.curve import QuadraticCurve
from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells
from paintlink.sketch.local import HELD_FROM_DEG

VERTICES_DEG = np.arange(30.0, 111.0)


def travel_curve(cells: Cells, angles_deg: tuple[float, ...]) -> Curve:
    """``c + a·max(0, θv − θ)²``, or the plain quadratic where that fits better.

    Each channel has a vertex θv of its own: shared by all three it costs ΔE 2.
    """
    y, weight = cells.lab, cells.weight / cells.weight.sum()
    form, form_misfit, vertex = _with_vertex(cells.theta_deg, y, weight)
    plain, plain_misfit = _plain(cells.theta_deg, y, weight)
    better = plain_misfit < form_misfit
    return QuadraticCurve(
        model="clamped",
        angles_deg=angles_deg,
        coefficients=np.where(better, plain, form),
        low_deg=np.zeros(3),
        high_deg=np.where(better, HELD_FROM_DEG, vertex),
    )


def _with_vertex(
    theta_deg: FloatArray, y: FloatArray, weight: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Coefficients, misfit and vertex of the best vertex for each channel."""
    rise = np.maximum(VERTICES_DEG[:, np.newaxis] - theta_deg, 0.0) ** 2
    middle, centre = rise @ weight, weight @ y
    rise -= middle[:, np.newaxis]
    spread = (rise * rise) @ weight
    shared = (rise * weight) @ (y - centre)
    slope = shared / np.maximum(spread, np.finfo(float).tiny)[:, np.newaxis]
    best = np.argmax(slope * shared, axis=0)
    channel = np.arange(3)
    a, vertex = slope[best, channel], VERTICES_DEG[best]
    c = centre - a * middle[best]
    misfit = weight @ (y - centre) ** 2 - a * shared[best, channel]
    return np.stack([a, -2.0 * a * vertex, c + a * vertex**2]), misfit, vertex


def _plain(
    theta_deg: FloatArray, y: FloatArray, weight: FloatArray
) -> tuple[FloatArray, FloatArray]:
    design = np.vander(np.minimum(theta_deg, HELD_FROM_DEG) / HELD_FROM_DEG, 3)
    root = np.sqrt(weight)[:, np.newaxis]
    solution = np.linalg.pinv(root * design) @ (root * y)
    misfit = weight @ (y - design @ solution) ** 2
    scale = HELD_FROM_DEG ** np.array([[-2.0], [-1.0], [0.0]])
    return solution * scale, misfit
