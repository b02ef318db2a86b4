"""Tables over the visible normals: an equal-angle disc, one texel per direction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.preview.arrays import Float32Array

QUARTER_TURN = np.pi / 2.0
NORMALS_AT_ONCE = 8192


def normals(size: int) -> Float32Array:
    """Normals of the texels of a disc, shape (size, size, 3), top row first.

    Texels outside the disc hold the normal of the rim nearest to them, so that
    interpolation works up to the rim.
    """
    across = 2.0 * (np.arange(size) + 0.5) / size - 1.0
    x, y = np.meshgrid(across, -across)
    radius = np.hypot(x, y)
    tilt = np.minimum(radius, 1.0) * QUARTER_TURN
    spread = np.sin(tilt) / np.maximum(radius, 1e-9)
    return np.stack([x * spread, y * spread, np.cos(tilt)], axis=-1).astype(np.float32)


def mirror_directions(normal: Float32Array) -> Float32Array:
    """Where the view from the front is mirrored to, shape (n, 3)."""
    mirror: Float32Array = 2.0 * normal[:, 2:] * normal
    mirror[:, 2] -= 1.0
    return mirror


def needed(size: int) -> NDArray[np.bool_]:
    """True for the texels that interpolation can reach, shape (size, size)."""
    across = 2.0 * (np.arange(size) + 0.5) / size - 1.0
    x, y = np.meshgrid(across, -across)
    reached: NDArray[np.bool_] = np.hypot(x, y) < 1.0 + 3.0 / size
    return reached


def look_up(table: Float32Array, normal: Float32Array) -> Float32Array:
    """Table interpolated at unit normals.

    Parameters
    ----------
    table
        Shape (size, size, k).
    normal
        Shape (n, 3); normals facing away take the values of the rim.

    Returns
    -------
    Shape (n, k).
    """
    values = np.empty((len(normal), table.shape[2]), dtype=np.float32)
    for start in range(0, len(normal), NORMALS_AT_ONCE):
        part = slice(start, start + NORMALS_AT_ONCE)
        values[part] = _interpolated(table, normal[part])
    return values


def _interpolated(table: Float32Array, normal: Float32Array) -> Float32Array:
    size = table.shape[0]
    texels = table.reshape(size * size, -1)
    column, row = position(normal, size)
    left, top = _cell(column, size), _cell(row, size)
    right = np.clip(column - left, 0.0, 1.0).astype(np.float32)[:, None]
    down = np.clip(row - top, 0.0, 1.0).astype(np.float32)[:, None]
    corner = top * size + left
    above = texels[corner] * (1.0 - right) + texels[corner + 1] * right
    corner += size
    below = texels[corner] * (1.0 - right) + texels[corner + 1] * right
    mixed: Float32Array = above + (below - above) * down
    return mixed


def position(normal: Float32Array, size: int) -> tuple[Float32Array, Float32Array]:
    """Column and row in texels, both shape (n,)."""
    level: Float32Array = np.maximum(np.hypot(normal[:, 0], normal[:, 1]), 1e-9)
    tilt: Float32Array = np.arctan2(level, np.maximum(normal[:, 2], 0.0))
    scale = tilt / level * np.float32(size / 2.0 / QUARTER_TURN)
    middle = np.float32(size / 2.0 - 0.5)
    return middle + normal[:, 0] * scale, middle - normal[:, 1] * scale


def _cell(position: Float32Array, size: int) -> NDArray[np.intp]:
    return np.clip(np.floor(position), 0, size - 2).astype(np.intp)
