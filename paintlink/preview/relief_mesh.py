"""A relief as triangles, for a camera that stands near."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import cast

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview import objects
from paintlink.preview.mesh import Mesh
from paintlink.preview.names import find
from paintlink.preview.relief import Shape

CELLS = 280
STEP = 1e-3


@cache
def relief_mesh(name: str) -> Mesh:
    """The relief ``name`` as a sheet of triangles, its rim on the outline."""
    shape = cast(Shape, import_module(find(name, objects, "object")))
    place = np.linspace(-1.0, 1.0, CELLS + 1)
    x, y = (values.ravel() for values in np.meshgrid(place, place))
    outside = shape.margin(x, y) < 0.0
    x, y = _pulled_in(shape, x, y, outside)
    faces = _cells(CELLS + 1)
    kept = faces[(~outside[faces]).any(axis=1)]
    vertices = np.stack([x, y, shape.height(x, y)], axis=1)
    used, again = np.unique(kept, return_inverse=True)
    return Mesh(_centred(vertices[used]), again.reshape(-1, 3))


def _pulled_in(
    shape: Shape, x: FloatArray, y: FloatArray, outside: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Places outside the outline moved onto it."""
    x, y = x.copy(), y.copy()
    for _ in range(3):
        px, py = x[outside], y[outside]
        margin = shape.margin(px, py)
        right = (shape.margin(px + STEP, py) - margin) / STEP
        up = (shape.margin(px, py + STEP) - margin) / STEP
        steep = np.maximum(right**2 + up**2, 0.25)
        x[outside] = px - margin * right / steep
        y[outside] = py - margin * up / steep
    return x, y


def _centred(vertices: FloatArray) -> FloatArray:
    """Vertices with the middle of their depth at 0."""
    depth = vertices[:, 2]
    centred: FloatArray = vertices - [0.0, 0.0, (depth.min() + depth.max()) / 2.0]
    return centred


def _cells(side: int) -> NDArray[np.intp]:
    """Two triangles for each cell of a square grid of vertices."""
    corner = np.arange((side - 1) * side).reshape(side - 1, side)[:, :-1].ravel()
    a, b, c, d = corner, corner + 1, corner + side, corner + side + 1
    return np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)])
