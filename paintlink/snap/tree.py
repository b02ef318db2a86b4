"""A balanced tree of boxes over the paints of a library, in plain arrays.

Halved again and again along its widest coordinate until a leaf holds at most 32
paints. All leaves have the same size, so that a handful of them is one gather; a few
paints stand twice to fill up, marked as absent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.snap.boxes import Box

LEAF_PAINTS = 32
ABSENT = -1
HUNDREDTH = 100.0
INT16_MOST = 32_767


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """Boxes in two levels, and the paints of each leaf.

    Parameters
    ----------
    upper
        Boxes over groups of leaves, shape (angles, 3, groups), float32.
    leaves
        Boxes of the leaves, low and high of shape (groups, angles, 3, fan), float32.
    points
        Lab of the paints, shape (leaves, angles, 3, size): hundredths in int16 where
        that loses nothing, else float64.
    rows
        Row of each paint, shape (leaves, size); `ABSENT` for one that fills up.
    """

    upper: Box
    leaves: Box
    points: NDArray[Any]
    rows: NDArray[np.int32]

    @property
    def fan(self) -> int:
        """Leaves in a group."""
        return int(self.leaves.low.shape[3])

    def lab(self, leaves: NDArray[np.int64]) -> FloatArray:
        """Lab of all paints of some leaves, shape (angles, 3, n)."""
        gathered = self.points[leaves].transpose(1, 2, 0, 3)
        if gathered.dtype == np.int16:
            lab: FloatArray = np.divide(gathered, HUNDREDTH, order="C")
        else:
            lab = np.ascontiguousarray(gathered)
        return lab.reshape(*lab.shape[:2], -1)


def build(planes: FloatArray, coordinates: FloatArray) -> Tree:
    """The tree over some paints.

    Parameters
    ----------
    planes
        Lab, shape (angles, 3, n), all finite, n at least 1.
    coordinates
        What the boxes are over: Lab itself or a transform of it, of the same shape.
    """
    angles, _, count = planes.shape
    depth = _depth(count)
    rows, absent = _arrange(coordinates.reshape(angles * 3, count), depth)
    low, high = _leaf_boxes(coordinates, rows)
    groups = 2 ** ((depth + 1) // 2)
    by_group = (angles, 3, groups, -1)
    points = _stored(planes)[:, :, rows].transpose(2, 0, 1, 3)
    return Tree(
        upper=Box(
            np.fmin.reduce(low.reshape(by_group), axis=3),
            np.fmax.reduce(high.reshape(by_group), axis=3),
        ),
        leaves=Box(
            np.ascontiguousarray(low.reshape(by_group).transpose(2, 0, 1, 3)),
            np.ascontiguousarray(high.reshape(by_group).transpose(2, 0, 1, 3)),
        ),
        points=np.ascontiguousarray(points),
        rows=np.where(absent, ABSENT, rows).astype(np.int32),
    )


def _depth(count: int) -> int:
    return max(int(count - 1).bit_length() - (LEAF_PAINTS.bit_length() - 1), 0)


def _arrange(
    coordinates: FloatArray, depth: int
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """Rows by leaf, shape (leaves, size), and which of them only fill up."""
    count = coordinates.shape[1]
    size = -(-count // 2**depth)
    spare = size * 2**depth - count
    fill = np.linspace(0, count - 1, spare).astype(np.int64)
    order = np.concatenate([np.arange(count), fill])
    absent = np.arange(order.size) >= count
    sorted_by = np.take(coordinates.astype(np.float32), order, axis=1)
    for level in range(depth):
        parts = sorted_by.reshape(len(coordinates), 2**level, -1)
        split = _halves(parts)
        order = np.take_along_axis(order.reshape(2**level, -1), split, axis=1)
        absent = np.take_along_axis(absent.reshape(2**level, -1), split, axis=1)
        sorted_by = np.stack([
            np.take_along_axis(part, split, axis=1).ravel() for part in parts
        ])
    return order.reshape(2**depth, size), absent.reshape(2**depth, size)


def _halves(parts: NDArray[np.float32]) -> NDArray[np.int64]:
    """Positions within each part, smaller half first along its widest coordinate."""
    extent = np.fmax.reduce(parts, axis=2) - np.fmin.reduce(parts, axis=2)
    widest = np.argmax(np.nan_to_num(extent), axis=0)
    keys = parts[widest, np.arange(parts.shape[1])]
    return np.argpartition(keys, keys.shape[1] // 2, axis=1)


def _leaf_boxes(coordinates: FloatArray, rows: NDArray[np.int64]) -> Box:
    """Boxes of the leaves, shape (angles, 3, leaves), rounded outwards."""
    low = np.empty((*coordinates.shape[:2], len(rows)), dtype=np.float32)
    high = np.empty_like(low)
    for index in np.ndindex(*coordinates.shape[:2]):
        values = coordinates[index][rows]
        low[index] = _outwards(np.fmin.reduce(values, axis=1), -np.inf)
        high[index] = _outwards(np.fmax.reduce(values, axis=1), np.inf)
    return Box(low, high)


def _outwards(edge: FloatArray, towards: float) -> NDArray[np.float32]:
    rounded = edge.astype(np.float32)
    inside = rounded > edge if towards < 0.0 else rounded < edge
    moved = np.nextafter(rounded, np.float32(towards))
    return np.where(inside, moved, rounded)


def _stored(planes: FloatArray) -> NDArray[Any]:
    """Lab in hundredths where every value survives that, else as it is."""
    hundredths = np.rint(planes * HUNDREDTH)
    lossless = np.array_equal(hundredths / HUNDREDTH, planes)
    if lossless and np.abs(hundredths).max() <= INT16_MOST:
        return hundredths.astype(np.int16)
    return planes
