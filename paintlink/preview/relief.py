"""Objects that are reliefs: height over the picture plane."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.preview.backdrop import Ellipse, backdrop
from paintlink.preview.surface import Surface, pixel_centres, samples_across
from paintlink.preview.view import FRONT

STEP = 5e-4
CONTACT_REACH = 0.10
CONTACT_DEPTH = 0.6

Relief = Callable[[FloatArray, FloatArray], FloatArray]


class Shape(Protocol):
    """What a relief in ``objects/`` declares; see the docstring of that folder."""

    LABEL: str
    SPAN: tuple[float, float]
    SHADOWS: tuple[Ellipse, ...]

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside the outline, negative outside, shape of ``x``."""
        ...

    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Height over the picture plane, shape of ``x``."""
        ...

    def normals(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Unit normals of points in or just outside the outline, shape (n, 3)."""
        ...


def surface(shape: Shape, size: int, rows: slice) -> Surface:
    """The relief straight from the front."""
    x, y = pixel_centres(size, rows)
    cover = np.clip(0.5 + shape.margin(x, y) * (size / 2.0), 0.0, 1.0)
    pixels = np.flatnonzero(cover > 0.0)
    inside_x, inside_y = x.ravel()[pixels], y.ravel()[pixels]
    offsets = _sample_offsets(size)
    samples = [shape.normals(inside_x + right, inside_y + up) for right, up in offsets]
    normals = np.stack(samples, axis=1).astype(np.float32)
    return Surface(
        view=FRONT,
        pixels=pixels,
        cover=cover.ravel()[pixels].astype(np.float32),
        first=np.arange(len(pixels)) * len(offsets),
        normals=normals.reshape(-1, 3),
        towards=None,
        lit=_lit(shape, inside_y, normals[:, 0]),
        behind=backdrop(x, y, shape.SHADOWS),
    )


def _lit(shape: Shape, y: FloatArray, normals: Float32Array) -> Float32Array:
    """Less light the nearer to the floor, and the more a place looks down to it."""
    above = y - min(shadow[1] for shadow in shape.SHADOWS)
    near = np.exp(-np.maximum(above, 0.0) / CONTACT_REACH)
    lit: FloatArray = 1.0 - CONTACT_DEPTH * near * (0.5 - 0.5 * normals[:, 1])
    return lit.astype(np.float32)


def _sample_offsets(size: int) -> list[tuple[float, float]]:
    """Places within a pixel to look at, relative to its centre, in picture units."""
    across = samples_across(size)
    steps = ((np.arange(across) + 0.5) / across - 0.5) * 2.0 / size
    return [(right, up) for right in steps for up in steps]


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
