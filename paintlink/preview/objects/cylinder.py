"""A sheet bent over a lying cylinder: the whole travel from face to flop at once.

Its axis lies across the picture, so that strips of several paints all show the same
angles and meet along the whole travel.
"""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.relief import hem, joined, normals_of

LABEL = "Cylinder"
HALF_LENGTH = 0.86
RADIUS = 0.60
HALF_HEIGHT = 0.57
CENTRE_Y = 0.04
SPAN = (-HALF_LENGTH, HALF_LENGTH)
SHADOWS = ((0.0, CENTRE_Y - HALF_HEIGHT - 0.03, 0.84, 0.06),)

CORNER = 0.10
HEM_WIDTH = 0.03
CROWN = 0.05


def margin(x: FloatArray, y: FloatArray) -> FloatArray:
    """Distance inside the outline."""
    across = HALF_LENGTH - np.abs(x)
    return joined(across, HALF_HEIGHT - np.abs(y - CENTRE_Y), CORNER)


def normals(x: FloatArray, y: FloatArray) -> FloatArray:
    """Unit normals, shape (n, 3)."""
    return normals_of(height, x, y)


def height(x: FloatArray, y: FloatArray) -> FloatArray:
    """Height over the picture plane."""
    up = (y - CENTRE_Y) / RADIUS
    bend = RADIUS * np.sqrt(np.maximum(1.0 - up**2, 1e-4))
    return bend - CROWN * x**2 + 0.02 * hem(margin(x, y), HEM_WIDTH)
