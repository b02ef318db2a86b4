"""What a colour's neighbours among makeable paints say about it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray

NEIGHBOURS = 32
CANDIDATES = 64
"""At least so many are found in 24 bits; of them the nearest are found exactly."""

BLOCK_POINTS = 1000
"""Multiplied at a time: small enough that BLAS does not start threads for it."""

GROUP_POINTS = 60
"""The 64th smallest of the least of each group is not below the 64th of all."""

NEAR = 0.5
SPAN = 1.5
FLOOR = 0.3
FEATURES = 6

Single = NDArray[np.float32]


def place(lab: FloatArray) -> FloatArray:
    """Lab (..., 3, 3) in a space of even steps, shape (..., 9).

    Chroma is compressed as CIE94 does, and L* above 100 halved.
    """
    L, a, b = lab[..., 0], lab[..., 1], lab[..., 2]
    C = 0.045 * np.sqrt(a * a + b * b)
    squeeze = np.where(C > 0.0, np.log1p(C) / np.where(C > 0.0, C, 1.0), 1.0)
    bright = np.where(L > 100.0, 100.0 + 0.5 * (L - 100.0), L)
    placed = np.stack([bright, a * squeeze, b * squeeze], axis=-1)
    spots: FloatArray = placed.reshape(*lab.shape[:-2], 9)
    return spots


def unplace(placed: FloatArray) -> FloatArray:
    """Lab (..., 3, 3) of spots (..., 9): the inverse of `place`."""
    spots = placed.reshape(*placed.shape[:-1], 3, 3)
    L, a, b = spots[..., 0], spots[..., 1], spots[..., 2]
    C = 0.045 * np.sqrt(a * a + b * b)
    stretch = np.where(C > 0.0, np.expm1(C) / np.where(C > 0.0, C, 1.0), 1.0)
    bright = np.where(L > 100.0, 100.0 + 2.0 * (L - 100.0), L)
    return np.stack([bright, a * stretch, b * stretch], axis=-1)


def nearest(cloud: Single, squares: Single, spot: FloatArray) -> NDArray[np.int64]:
    """Rows of the nearest points of a cloud (n, 9), nearest first.

    Parameters
    ----------
    squares
        Squared length of each point, shape (n,).
    """
    blocks = cloud.reshape(-1, BLOCK_POINTS, cloud.shape[1])
    rough = squares - 2.0 * (blocks @ spot.astype(np.float32)).ravel()
    least = rough.reshape(-1, GROUP_POINTS).min(axis=1)
    limit = np.partition(least, CANDIDATES)[CANDIDATES]
    rows = np.flatnonzero(rough <= limit)
    distance = ((cloud[rows] - spot) ** 2).sum(axis=1)
    return rows[np.argsort(distance)[:NEIGHBOURS]]


def features(neighbours: FloatArray, spot: FloatArray) -> FloatArray:
    """Logarithms of six distances of a spot from its neighbours (32, 9), shape (6,).

    To the nearest, mean to 5, mean to 32, across the directions in which the
    neighbours spread, to their middle, and to it in units of their spread.
    """
    distance = np.sqrt(((neighbours - spot) ** 2).sum(axis=1))
    weights = 1.0 / (distance + NEAR)
    weights /= weights.sum()
    middle = weights @ neighbours
    spread = neighbours - middle
    variance, axes = np.linalg.eigh((spread * weights[:, np.newaxis]).T @ spread)
    away = (spot - middle) @ axes
    squared = away * away
    across = (squared * SPAN**2 / (np.maximum(variance, 0.0) + SPAN**2)).sum()
    in_spread = (squared / (np.maximum(variance, 0.0) + FLOOR)).mean()
    values = np.array([
        distance[0],
        distance[:5].mean(),
        distance.mean(),
        np.sqrt(across),
        np.sqrt(squared.sum()),
        np.sqrt(in_spread),
    ])
    return np.log(values + 0.01)
