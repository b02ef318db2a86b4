"""A bonnet seen from the front: two creases, rolling over towards the grille.

Left and right are alike, which suits the comparison of two paints.
"""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.relief import normals_of, ridge

LABEL = "Bonnet"
SPAN = (-0.90, 0.90)
SHADOWS = ((0.0, -0.66, 0.84, 0.07),)

HALF_HEIGHT = 0.62
CENTRE_Y = 0.03
ROLL_Y = -0.22
ROLL_SOFTNESS = 0.13


def margin(x: FloatArray, y: FloatArray) -> FloatArray:
    """Distance inside the outline, to first order."""
    step = 1e-3
    level = _outline(x, y)
    across = (_outline(x + step, y) - level) / step
    up = (_outline(x, y + step) - level) / step
    return level / np.maximum(np.hypot(across, up), 1e-6)


def normals(x: FloatArray, y: FloatArray) -> FloatArray:
    """Unit normals, shape (n, 3)."""
    return normals_of(height, x, y)


def height(x: FloatArray, y: FloatArray) -> FloatArray:
    """Height over the picture plane."""
    edge = 0.07 * np.sqrt(np.maximum(_outline(x, y), 1e-4))
    crown = 0.40 * np.abs(x) ** 2.6
    from_middle = 0.44 - 0.15 * _along(y) + 0.03 * _along(y) ** 2
    creases = ridge(x - from_middle, 0.015) + ridge(x + from_middle, 0.015)
    return edge + _section(y) - crown - 0.15 * creases


def _section(y: FloatArray) -> FloatArray:
    """Middle of the bonnet from the grille up: steep, rolling over, leaning back."""
    roll = ROLL_SOFTNESS * np.logaddexp(0.0, (y - ROLL_Y) / ROLL_SOFTNESS)
    section: FloatArray = 0.38 * y - 0.72 * roll - 0.36 * np.maximum(y + 0.3, 0.0) ** 2
    return section


def _outline(x: FloatArray, y: FloatArray) -> FloatArray:
    """1 in the middle, 0 on the outline: a bowed, tapering superellipse."""
    along = _along(y)
    half_width = 0.86 - 0.10 * along - 0.07 * along**2
    bowed = (y - CENTRE_Y) * (1.0 + 0.24 * x**2) / HALF_HEIGHT
    level: FloatArray = 1.0 - np.abs(x / half_width) ** 8 - np.abs(bowed) ** 9
    return level


def _along(y: FloatArray) -> FloatArray:
    return np.clip(y / 0.66, -1.1, 1.1)
