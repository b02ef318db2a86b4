"""A ball: every visible normal once."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray

LABEL = "Sphere"
RADIUS = 0.74
CENTRE_Y = 0.05
SPAN = (-RADIUS, RADIUS)
SHADOWS = ((0.0, CENTRE_Y - RADIUS - 0.01, 0.62, 0.07),)


def margin(x: FloatArray, y: FloatArray) -> FloatArray:
    """Distance inside the outline."""
    inside: FloatArray = RADIUS - np.hypot(x, y - CENTRE_Y)
    return inside


def height(x: FloatArray, y: FloatArray) -> FloatArray:
    """Height over the picture plane."""
    level = RADIUS**2 - x**2 - (y - CENTRE_Y) ** 2
    front: FloatArray = np.sqrt(np.maximum(level, 0.0))
    return front


def normals(x: FloatArray, y: FloatArray) -> FloatArray:
    """Unit normals, shape (n, 3)."""
    across, up = x / RADIUS, (y - CENTRE_Y) / RADIUS
    outside = np.maximum(np.hypot(across, up), 1.0)
    across, up = across / outside, up / outside
    towards = np.sqrt(np.maximum(1.0 - across**2 - up**2, 0.0))
    return np.stack([across, up, towards], axis=1)
