"""A front wing: shoulder line, flared wheel arch, rolled edges."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.relief import hem, joined, normals_of, ramp, ridge

LABEL = "Front wing"
SPAN = (-0.94, 0.90)
SHADOWS = ((-0.76, -0.56, 0.16, 0.035), (0.54, -0.58, 0.42, 0.05))

WHEEL = (-0.22, -0.52)
WHEEL_RADIUS = 0.46
HEM_WIDTH = 0.05


def margin(x: FloatArray, y: FloatArray) -> FloatArray:
    """Distance inside the outline."""
    bonnet_line = 0.50 + 0.02 * x - 0.16 * (x - 0.35) ** 2 - y
    door = 0.90 - 0.10 * y**2 - 0.04 * y - x
    nose = x + 0.93 - 0.55 * y**2 - 0.10 * y
    sill = y + 0.56
    body = joined(joined(bonnet_line, door, 0.10), nose, 0.22)
    return joined(joined(body, sill, 0.10), _from_wheel(x, y), 0.07)


def normals(x: FloatArray, y: FloatArray) -> FloatArray:
    """Unit normals, shape (n, 3)."""
    return normals_of(height, x, y)


def height(x: FloatArray, y: FloatArray) -> FloatArray:
    """Height over the picture plane."""
    edge = 0.035 * hem(margin(x, y), HEM_WIDTH)
    return edge - _skin(x, y) + _lines(x, y) + _flare(x, y)


def _skin(x: FloatArray, y: FloatArray) -> FloatArray:
    """How far the sheet curves away: in above the shoulder, tucked in below."""
    above, below = np.maximum(y - 0.05, 0.0), np.minimum(y - 0.05, 0.0)
    ahead, behind = np.minimum(x + 0.25, 0.0), np.maximum(x, 0.0)
    skin: FloatArray = 1.05 * above**2 + 0.22 * below**2
    skin += 0.55 * ahead**2 + 0.05 * behind**2
    return skin


def _lines(x: FloatArray, y: FloatArray) -> FloatArray:
    """The shoulder line, and a crease behind the wheel that catches light below it."""
    shoulder = y - (0.22 + 0.04 * x - 0.05 * (x - 0.4) ** 2)
    crease = -0.16 + 0.14 * x - y
    behind_wheel = 0.5 + 0.5 * np.tanh((x - 0.34) / 0.10)
    catcher: FloatArray = 0.30 * behind_wheel * ramp(crease, 0.02)
    return catcher - 0.11 * ridge(shoulder, 0.018)


def _flare(x: FloatArray, y: FloatArray) -> FloatArray:
    outside = np.maximum(_from_wheel(x, y), 0.0)
    lip: FloatArray = 0.075 * np.exp(-((outside / 0.10) ** 1.6))
    return lip


def _from_wheel(x: FloatArray, y: FloatArray) -> FloatArray:
    distance: FloatArray = np.hypot(x - WHEEL[0], y - WHEEL[1]) - WHEEL_RADIUS
    return distance
