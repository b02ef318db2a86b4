"""A low sun in a red horizon under a blue sky."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

LABEL = "Sunset"

SUN = np.array([0.62, 0.16, 0.62]) / np.linalg.norm([0.62, 0.16, 0.62])
SUN_RADIUS_DEG = 2.5
SUN_RADIANCE = 260.0
SUN_COLOUR = (1.0, 0.62, 0.32)
ZENITH = (0.16, 0.24, 0.46)
HORIZON = (1.15, 0.62, 0.34)
GROUND = (0.10, 0.09, 0.09)


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3)."""
    direction = directions.astype(np.float64)
    height = direction[:, 1:2]
    cosine = np.clip(direction @ SUN, -1.0, 1.0)
    from_sun = np.degrees(np.arccos(cosine))[:, None]
    disc = SUN_RADIANCE * _step((SUN_RADIUS_DEG - from_sun) / 0.25)
    glow = 2.2 * np.exp(-from_sun / 14.0)
    towards_sun = 0.35 + 0.65 * ((1.0 + cosine[:, None]) / 2.0) ** 2
    band = np.exp(-5.0 * np.maximum(height, 0.0)) * towards_sun * np.array(HORIZON)
    sky = np.array(ZENITH) + band + (disc + glow) * np.array(SUN_COLOUR)
    above = _step(height / 0.02)
    seen: FloatArray = above * sky + (1.0 - above) * np.array(GROUND)
    return seen.astype(np.float32)


def _step(x: FloatArray) -> FloatArray:
    """Logistic step from 0 to 1."""
    step: FloatArray = 0.5 + 0.5 * np.tanh(0.5 * x)
    return step
