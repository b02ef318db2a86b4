"""Baked light brought to the pixels of a surface."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview import disc
from paintlink.preview.arrays import Float32Array
from paintlink.preview.surface import Surface
from paintlink.preview.view import View

PIXELS_AT_ONCE = 4096
REACH_DEG = 14.0
"""From the middle of a picture to its sides, in perspective."""

FINE_NODES = (-1.0, 0.0, 1.0)
COARSE_NODES = (-1.0, 1.0)

TableOf = Callable[[View], Float32Array]


def gather(
    surface: Surface, table_of: TableOf, nodes: Sequence[float] = FINE_NODES
) -> Float32Array:
    """Table values averaged over the samples of each pixel, shape (k, n).

    Parameters
    ----------
    nodes
        Where perspective has tables of its own, on both axes, 1 being the side of the
        picture.
    """
    look = _looker(surface, table_of, nodes)
    count = len(surface.pixels)
    ends = np.append(surface.first, len(surface.normals))
    gathered = np.empty((look(slice(0, 0)).shape[1], count), dtype=np.float32)
    for start in range(0, count, PIXELS_AT_ONCE):
        stop = min(start + PIXELS_AT_ONCE, count)
        values = look(slice(ends[start], ends[stop]))
        sums = np.add.reduceat(values, ends[start:stop] - ends[start], axis=0)
        samples = np.diff(ends[start : stop + 1]).astype(np.float32)
        gathered[:, start:stop] = (sums / samples[:, None]).T
    return gathered


def _looker(
    surface: Surface, table_of: TableOf, nodes: Sequence[float]
) -> Callable[[slice], Float32Array]:
    """Function of a run of samples that gives their values, shape (samples, k)."""
    towards = surface.towards
    if towards is None:
        table = table_of(surface.view)
        return lambda some: disc.look_up(table, surface.normals[some])
    views, weights = _around(surface.view, towards, nodes)
    tables = [table_of(view) for view in views]
    mirror = _mirrored(surface.normals, towards)

    def look(some: slice) -> Float32Array:
        total: Float32Array = np.float32(0.0)  # type: ignore[assignment]
        for view, table, weight in zip(views, tables, weights, strict=True):
            normals = _facing(surface.view, view, mirror[some])
            total = total + disc.look_up(table, normals) * weight[some, None]
        return total

    return look


def _around(
    view: View, towards: Float32Array, nodes: Sequence[float]
) -> tuple[Sequence[View], Sequence[Float32Array]]:
    """Views that enclose all directions, and how much each counts, (m,) each.

    At a fixed mirror direction the light changes so little with the view that mixing a
    few tables is enough.
    """
    right = np.degrees(np.arctan2(towards[:, 0], towards[:, 2])) / REACH_DEG
    up = np.degrees(np.arcsin(np.clip(towards[:, 1], -1.0, 1.0))) / REACH_DEG
    across, along = _shares(right, nodes), _shares(up, nodes)
    views = [
        View(view.pitch_deg + y * REACH_DEG, view.yaw_deg + x * REACH_DEG)
        for x in nodes
        for y in nodes
    ]
    return views, [x * y for x in across for y in along]


def _shares(place: FloatArray, nodes: Sequence[float]) -> list[Float32Array]:
    """Lagrange's weights of the nodes at places, (m,) each."""
    place = np.clip(place, -1.1, 1.1)
    shares = []
    for node in nodes:
        others = [other for other in nodes if other != node]
        factors = [(place - other) / (node - other) for other in others]
        shares.append(np.prod(factors, axis=0).astype(np.float32))
    return shares


def _mirrored(normals: Float32Array, towards: Float32Array) -> Float32Array:
    cosine = np.maximum(np.einsum("mc,mc->m", normals, towards), 0.0)
    mirror: Float32Array = 2.0 * cosine[:, None] * normals - towards
    return mirror


def _facing(seen_from: View, view: View, mirror: Float32Array) -> Float32Array:
    """Normals that mirror another view to the same direction, as it sees them."""
    half = view.inward(seen_from.outward(mirror))
    half[:, 2] += 1.0
    half /= np.maximum(np.linalg.norm(half, axis=1, keepdims=True), 1e-6)
    return half
