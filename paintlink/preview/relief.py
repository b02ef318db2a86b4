"""Building blocks of objects that are reliefs: height over the picture plane."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from paintlink.model import FloatArray

STEP = 5e-4

Relief = Callable[[FloatArray, FloatArray], FloatArray]


def normals_of(height: Relief, x: FloatArray, y: FloatArray) -> FloatArray:
    """Unit normals of a relief by central differences, shape (n, 3)."""
    x, y = x.astype(np.float64), y.astype(np.float64)
    right = (height(x + STEP, y) - height(x - STEP, y)) / (2.0 * STEP)
    up = (height(x, y + STEP) - height(x, y - STEP)) / (2.0 * STEP)
    normal = np.stack([-right, -up, np.ones_like(right)], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return normal.astype(np.float32)


def ridge(distance: FloatArray, radius: float) -> FloatArray:
    """Distance without its sign, rounded at 0: the section of a character line."""
    rounded: FloatArray = np.sqrt(distance**2 + radius**2)
    return rounded


def ramp(distance: FloatArray, radius: float) -> FloatArray:
    """Distance where positive, 0 where negative, rounded between."""
    return 0.5 * (distance + ridge(distance, radius))


def joined(first: FloatArray, second: FloatArray, radius: float) -> FloatArray:
    """The smaller of two distances inside an outline, with the corner rounded.

    Source: the polynomial smooth minimum of Inigo Quilez.
    """
    overlap = np.maximum(radius - np.abs(first - second), 0.0) / radius
    smaller: FloatArray = np.minimum(first, second) - overlap**2 * radius / 4.0
    return smaller


def hem(inside: FloatArray, width: float) -> FloatArray:
    """Quarter round along the outline, rising from 0 to 1 over ``width``."""
    share = np.clip(inside / width, 0.0, 1.0)
    rise: FloatArray = np.sqrt(np.maximum(1.0 - (1.0 - share) ** 2, 1e-6))
    return rise
