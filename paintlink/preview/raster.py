"""Which triangle is nearest, for every place of a raster."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray

FRAGMENTS_AT_ONCE = 1 << 21
NOTHING = -1


class Raster(NamedTuple):
    """What is nearest at each place, both of shape (height * width,).

    Parameters
    ----------
    face
        Number of the triangle, or ``NOTHING``.
    nearness
        Its nearness there, minus infinity where there is nothing.
    """

    face: NDArray[np.int32]
    nearness: FloatArray


class _Boxes(NamedTuple):
    """First column and row of each triangle's box, and its columns and rows."""

    left: NDArray[np.intp]
    top: NDArray[np.intp]
    columns: NDArray[np.intp]
    rows: NDArray[np.intp]


def rasterise(corners: FloatArray, width: int, height: int) -> Raster:
    """The nearest of both sides of the triangles, at the centres of the places.

    Parameters
    ----------
    corners
        Column, row and nearness of the corners of each triangle, shape (t, 3, 3); the
        first place spans columns 0 to 1. Nearness runs linearly in the raster.
    """
    raster = Raster(
        np.full(width * height, NOTHING, dtype=np.int32),
        np.full(width * height, -np.inf),
    )
    boxes = _boxes(corners, width, height)
    for some in _portions(boxes.columns * boxes.rows):
        _draw(raster, corners, some, boxes, width)
    return raster


def barycentric(corners: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Weights of the corners of each triangle at a place, shape (n, 3).

    Parameters
    ----------
    corners
        Shape (n, 3, 2 or more).
    """
    (ax, ay), (bx, by), (cx, cy) = (corners[:, i, :2].T for i in range(3))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    area = np.where(area == 0.0, 1e-30, area)
    b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    return np.stack([1.0 - b - c, b, c], axis=1)


def _boxes(corners: FloatArray, width: int, height: int) -> _Boxes:
    low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
    limit = np.array([width, height])
    first = np.clip(np.ceil(low - 0.5), 0, limit).astype(np.intp)
    last = np.clip(np.floor(high - 0.5), -1, limit - 1).astype(np.intp)
    spread = np.maximum(last - first + 1, 0)
    return _Boxes(first[:, 0], first[:, 1], spread[:, 0], spread[:, 1])


def _portions(fragments: NDArray[np.intp]) -> Iterator[NDArray[np.intp]]:
    """Triangles that meet the raster, in runs of a bounded number of fragments."""
    hit = np.flatnonzero(fragments)
    if not len(hit):
        return
    run = np.cumsum(fragments[hit]) // FRAGMENTS_AT_ONCE
    yield from np.split(hit, np.flatnonzero(np.diff(run)) + 1)


def _draw(
    raster: Raster,
    corners: FloatArray,
    some: NDArray[np.intp],
    boxes: _Boxes,
    width: int,
) -> None:
    columns, count = boxes.columns[some], boxes.columns[some] * boxes.rows[some]
    within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    face, wide = np.repeat(some, count), np.repeat(columns, count)
    row, column = np.divmod(within, wide)
    row, column = row + boxes.top[face], column + boxes.left[face]
    weights = barycentric(corners[face], column + 0.5, row + 0.5)
    inside = (weights >= -1e-9).all(axis=1)
    face, place = face[inside], (row * width + column)[inside]
    nearness = np.einsum("ni,ni->n", weights[inside], corners[face, :, 2])
    ahead = nearness > raster.nearness[place]
    face, place, nearness = face[ahead], place[ahead], nearness[ahead]
    order = np.argsort(nearness, kind="stable")
    raster.face[place[order]] = face[order]
    raster.nearness[place[order]] = nearness[order]
