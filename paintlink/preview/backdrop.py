"""The neutral studio behind and below the object."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

Ellipse = tuple[float, float, float, float]
"""Centre x and y, half axes along x and y."""

WALL = 0.30
GLOW = 0.16
FLOOR = 0.12
HORIZON_SOFTNESS = 0.10
SHADE = 0.95


def backdrop(x: FloatArray, y: FloatArray, shadows: tuple[Ellipse, ...]) -> FloatArray:
    """Linear grey of the wall, the floor and the contact shadows, shape of ``x``.

    Parameters
    ----------
    shadows
        Where the object meets the floor.
    """
    height = y - max(shadow[1] for shadow in shadows) - 0.1
    wall = WALL + GLOW * np.exp(-((x / 1.1) ** 2) - ((y - 0.15) / 0.9) ** 2)
    grey = wall + FLOOR * 0.5 * (1.0 - np.tanh(0.5 * height / HORIZON_SOFTNESS))
    for shadow in shadows:
        grey *= _let_through(x, y, shadow)
    return grey


def floor_and_wall(x: FloatArray, y: FloatArray, open_share: FloatArray) -> FloatArray:
    """Linear grey of a floor that bends up to a wall, shape of ``x``.

    Parameters
    ----------
    open_share
        Share of the light that reaches the floor at each place.
    """
    wall = WALL + GLOW * np.exp(-((x / 1.1) ** 2) - ((y - 0.15) / 0.9) ** 2)
    floor = FLOOR * 0.5 * (1.0 - np.tanh((y + 0.25) / (4.0 * HORIZON_SOFTNESS)))
    grey: FloatArray = (wall + floor) * (1.0 - SHADE * (1.0 - open_share))
    return grey


def _let_through(x: FloatArray, y: FloatArray, shadow: Ellipse) -> FloatArray:
    """Share of the light a shadow leaves: a dark core in a wide soft halo."""
    centre_x, centre_y, half_width, half_height = shadow
    across, up = (x - centre_x) / half_width, (y - centre_y) / half_height
    core = 0.75 * np.exp(-1.2 * (across**2 + up**2))
    halo = 0.35 * np.exp(-((across / 1.5) ** 2) - (up / 3.2) ** 2)
    left: FloatArray = (1.0 - core) * (1.0 - halo)
    return left


def dither(rows: slice, columns: int) -> Float32Array:
    """Ordered pattern between -0.5 and 0.5 that keeps soft gradients free of bands."""
    tile = np.zeros((1, 1))
    for _ in range(3):
        tile = np.block([[4 * tile, 4 * tile + 2], [4 * tile + 3, 4 * tile + 1]])
    row = np.arange(rows.start, rows.stop)[:, None] % 8
    column = np.arange(columns)[None, :] % 8
    pattern = ((tile + 0.5) / 64.0 - 0.5).astype(np.float32)
    tiled: Float32Array = pattern[row, column]
    return tiled
