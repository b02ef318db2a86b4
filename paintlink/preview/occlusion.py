"""How much of the light a mesh hides from itself and from the floor it stands on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.preview.mesh import Mesh
from paintlink.preview.raster import rasterise

DIRECTIONS = 128
FEWEST_DIRECTIONS = 16
TRIANGLES_IN_ALL = 4_000_000
RASTER = 128
BIAS = 0.02
FLOOR_CELLS = 64
FLOOR_REACH = 2.0


@dataclass(frozen=True, eq=False)
class Occlusion:
    """Share of the light that arrives, 0 to 1.

    Parameters
    ----------
    vertices
        At each vertex, on the side of its normal and on the other, shape (v, 2).
    floor
        At the centres of a grid below the mesh, x from left to right and z from back
        to front, both from -2 to 2, shape (64, 64).
    """

    vertices: Float32Array
    floor: Float32Array

    def on_floor(self, x: FloatArray, z: FloatArray) -> FloatArray:
        """Share at places of the floor, shape of ``x``; 1 off the grid."""
        column, row = (
            np.clip(
                (place / FLOOR_REACH + 1.0) / 2.0 * FLOOR_CELLS - 0.5,
                0.0,
                FLOOR_CELLS - 1.001,
            )
            for place in (x, z)
        )
        left, top = column.astype(np.intp), row.astype(np.intp)
        right, down = column - left, row - top
        grid = self.floor
        upper = grid[top, left] * (1 - right) + grid[top, left + 1] * right
        lower = grid[top + 1, left] * (1 - right) + grid[top + 1, left + 1] * right
        share: FloatArray = upper + (lower - upper) * down
        return share


def occlusion(mesh: Mesh) -> Occlusion:
    """Occlusion by depth rasters from all around.

    Light from below comes from the floor, which is itself in the shade of the mesh.
    """
    normals = mesh.vertex_normals
    ground = _floor_places(mesh)
    count = min(DIRECTIONS, max(FEWEST_DIRECTIONS, TRIANGLES_IN_ALL // len(mesh.faces)))
    directions = _sphere(count)
    seen_above = [_Depth(mesh, axis) for axis in directions if axis[1] > 0.0]
    floor = _smooth(
        _mean(
            (depth.clear(ground) * depth.axis[1], np.full(len(ground), depth.axis[1]))
            for depth in seen_above
        ).reshape(FLOOR_CELLS, FLOOR_CELLS)
    )
    shade = Occlusion(np.ones((0, 2), dtype=np.float32), floor)
    depths = [*seen_above, *(_Depth(mesh, axis) for axis in directions if axis[1] <= 0)]
    front, back = (
        _mean(_arriving(mesh, side, depth, shade) for depth in depths)
        for side in (normals, -normals)
    )
    return Occlusion(np.stack([front, back], axis=1), floor)


class _Depth:
    """The mesh seen from far along an axis."""

    def __init__(self, mesh: Mesh, axis: FloatArray) -> None:
        helper = [1.0, 0.0, 0.0] if abs(axis[1]) > 0.9 else [0.0, 1.0, 0.0]
        right = np.cross(helper, axis)
        right /= np.linalg.norm(right)
        self.axis = axis
        self._frame = np.stack([right, np.cross(axis, right), axis])
        self._scale = RASTER / 2.0 / np.linalg.norm(mesh.vertices, axis=1).max()
        corners = self._placed(mesh.vertices)[mesh.faces]
        self._nearness = rasterise(corners, RASTER, RASTER).nearness

    def clear(self, points: FloatArray) -> FloatArray:
        """1 where nothing stands between a point and the axis' far end, (n,)."""
        placed = self._placed(points)
        cell = np.floor(placed[:, :2]).astype(np.intp)
        within = ((cell >= 0) & (cell < RASTER)).all(axis=1)
        cell = np.clip(cell, 0, RASTER - 1)
        nearest = self._nearness[cell[:, 1] * RASTER + cell[:, 0]]
        clear: FloatArray = (~within | (placed[:, 2] + BIAS >= nearest)) * 1.0
        return clear

    def _placed(self, points: FloatArray) -> FloatArray:
        placed: FloatArray = points @ self._frame.T
        placed[:, :2] = placed[:, :2] * self._scale + RASTER / 2.0
        return placed


def _arriving(
    mesh: Mesh, normals: FloatArray, depth: _Depth, shade: Occlusion
) -> tuple[FloatArray, FloatArray]:
    """Light of a direction that reaches each vertex, and that would unhidden."""
    facing = np.maximum(normals @ depth.axis, 0.0)
    arriving = facing * depth.clear(mesh.vertices + BIAS * normals)
    if depth.axis[1] < -0.05:
        drop = (mesh.vertices[:, 1] - mesh.vertices[:, 1].min()) / -depth.axis[1]
        x = mesh.vertices[:, 0] + drop * depth.axis[0]
        z = mesh.vertices[:, 2] + drop * depth.axis[2]
        arriving = arriving * shade.on_floor(x, z)
    return arriving, facing


def _mean(parts: Iterator[tuple[FloatArray, FloatArray]]) -> Float32Array:
    arrived, possible = (sum(values) for values in zip(*parts, strict=True))
    share: Float32Array = (arrived / np.maximum(possible, 1e-9)).astype(np.float32)
    return share


def _smooth(floor: Float32Array) -> Float32Array:
    """Without the streaks of single directions, and clear at the border."""
    for axis in (0, 1) * 2:
        floor = (np.roll(floor, 1, axis) + 2.0 * floor + np.roll(floor, -1, axis)) / 4.0
    place = np.abs(np.linspace(-1.0, 1.0, FLOOR_CELLS))
    inside = np.clip((1.0 - np.maximum.outer(place, place)) / 0.3, 0.0, 1.0)
    smoothed: Float32Array = (1.0 - inside * (1.0 - floor)).astype(np.float32)
    return smoothed


def _floor_places(mesh: Mesh) -> FloatArray:
    place = ((np.arange(FLOOR_CELLS) + 0.5) / FLOOR_CELLS * 2.0 - 1.0) * FLOOR_REACH
    x, z = np.meshgrid(place, place)
    y = np.full_like(x, mesh.vertices[:, 1].min() - 0.001)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3)


def _sphere(count: int) -> FloatArray:
    """Evenly spread directions, shape (count, 3): a Fibonacci lattice."""
    number = np.arange(count) + 0.5
    y = 1.0 - 2.0 * number / count
    turn = np.pi * (1.0 + np.sqrt(5.0)) * number
    level = np.sqrt(1.0 - y**2)
    return np.stack([level * np.cos(turn), y, level * np.sin(turn)], axis=1)
