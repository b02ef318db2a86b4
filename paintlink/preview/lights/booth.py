"""A light booth: one wide lamp behind a diffuser above, grey walls, as for judging."""

from __future__ import annotations

import numpy as np

from paintlink.preview.arrays import Float32Array
from paintlink.preview.softbox import Softbox

LABEL = "Light booth"

WALL = 0.20
"""Reflectance of neutral grey N5 paint: Munsell value 5 reflects 19.8 %."""

LAMP = Softbox((0.0, 1.0, 0.10), 0.85, 0.35, 6.0, up=(0.0, 0.0, 1.0), edge=0.03)


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3); walls are lighter the nearer to the lamp."""
    height = directions[:, 1]
    walls = WALL * (1.6 + 0.9 * height)
    room = 0.5 + 0.5 * np.tanh((0.35 - directions[:, 2]) / 0.15)
    level = walls * (0.25 + 0.75 * room) + LAMP.seen_along(directions)
    return np.repeat(level[:, None], 3, axis=1).astype(np.float32)
