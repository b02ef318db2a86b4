"""A speed shape: a car without windows, as paint makers spray it to show a colour."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview.mesh import Mesh, checked

LABEL = "Car"

STATIONS = 300
AROUND = 240
LENGTH = 2.05
SILL_DEG = -88.0
BELLY = 0.15
WHEELS = (-0.60, 0.62)
WHEEL_HEIGHT = -0.045
WHEEL_RADIUS = 0.170


@cache
def mesh() -> Mesh:
    """The body, nose to the left and a little towards the viewer."""
    along = np.sin(np.linspace(-np.pi / 2, np.pi / 2, STATIONS))
    along = 0.55 * along + 0.45 * np.linspace(-1.0, 1.0, STATIONS)
    around = np.radians(np.linspace(SILL_DEG, 180.0 - SILL_DEG, AROUND))
    u, angle = np.meshgrid(along, around, indexing="ij")
    radius = _radius(u, angle)
    body = np.stack(
        [LENGTH * u / 2.0, radius * np.sin(angle), radius * np.cos(angle)], axis=-1
    )
    body[..., 2] *= 1.0 - 0.16 * _step((np.abs(u) - 0.55) / 0.30) * u**2
    return checked(_posed(body.reshape(-1, 3)), _quads(STATIONS, AROUND), LABEL)


def _posed(points: FloatArray) -> FloatArray:
    turn = np.radians(34.0)
    cosine, sine = np.cos(turn), np.sin(turn)
    x, y, z = points.T
    return np.stack([cosine * x + sine * z, y, cosine * z - sine * x], axis=1)


def _radius(u: FloatArray, angle: FloatArray) -> FloatArray:
    """Distance of the skin from the axis of the car at each station and angle."""
    nose = np.maximum(1.0 - np.maximum(-u, 0.0) ** 5, 0.0) ** 0.55
    tail = np.maximum(1.0 - np.maximum(u, 0.0) ** 9, 0.0) ** 0.5
    ends = nose * tail
    belly = _super(angle, 0.43 * ends, BELLY * ends, 5.0)
    body = _super(angle, 0.43 * ends, _bonnet(u) * ends, 3.6)
    cabin = _super(angle, 0.33 * ends, np.maximum(ends * _roof(u), 1e-3), 2.7)
    upper = (body**14 + cabin**14) ** (1.0 / 14.0)
    skin = np.where(np.sin(angle) < 0.0, belly, upper)
    skin += 0.016 * ends * _shoulder(u, angle)
    return skin + ends * _arches(u, angle, skin)


def _bonnet(u: FloatArray) -> FloatArray:
    """Height of the lower body: a falling nose and a lifted tail."""
    wedge = 0.205 + 0.050 * (u + 1.0) / 2.0
    height: FloatArray = wedge + 0.02 * _step((u - 0.3) / 0.4)
    return height


def _roof(u: FloatArray) -> FloatArray:
    """Height of the cabin over the axis, a fastback."""
    front = _step((u + 0.24) / 0.20)
    back = _step((0.80 - u) / 0.34)
    roof: FloatArray = 0.445 * front * back
    return roof


def _shoulder(u: FloatArray, angle: FloatArray) -> FloatArray:
    """A crease along each flank that rises to the tail and fades at the nose."""
    beside = np.degrees(np.minimum(angle, np.pi - angle))
    line = beside - (15.0 + 5.0 * u)
    upper = np.exp(-np.maximum(line, 0.0) / 4.0)
    lower = np.exp(-((np.minimum(line, 0.0) / 16.0) ** 2))
    crease: FloatArray = upper * lower * _step((u + 0.75) / 0.2)
    return crease


def _arches(u: FloatArray, angle: FloatArray, skin: FloatArray) -> FloatArray:
    """Muscles over the wheels, and the covers of the wheels set in a little."""
    x, y = LENGTH * u / 2.0, skin * np.sin(angle) - WHEEL_HEIGHT
    beside = np.clip((np.cos(angle) ** 2 - 0.35) / 0.5, 0.0, 1.0)
    total = np.zeros_like(u)
    for wheel in WHEELS:
        outside = np.hypot(x - wheel * LENGTH / 2.0, y) - WHEEL_RADIUS
        muscle = 0.030 * np.exp(-((np.maximum(outside, 0.0) / 0.12) ** 2))
        cover = 0.022 * _step(-outside / 0.010)
        total += beside * (muscle - cover)
    return total


def _super(
    angle: FloatArray, half_width: FloatArray, height: FloatArray, power: float
) -> FloatArray:
    """Radius of a superellipse."""
    across = np.abs(np.cos(angle)) / np.maximum(half_width, 1e-4)
    upward = np.abs(np.sin(angle)) / np.maximum(height, 1e-4)
    radius: FloatArray = (across**power + upward**power) ** (-1.0 / power)
    return radius


def _step(x: FloatArray) -> FloatArray:
    """Smooth step from 0 to 1."""
    step: FloatArray = 0.5 + 0.5 * np.tanh(x)
    return step


def _quads(rows: int, columns: int) -> NDArray[np.intp]:
    """Two triangles for each cell of a grid of vertices."""
    corner = np.arange((rows - 1) * columns).reshape(rows - 1, columns)[:, :-1].ravel()
    a, b = corner, corner + 1
    c, d = corner + columns, corner + columns + 1
    return np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)])
