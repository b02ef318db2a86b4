"""Open sky with the sun, coloured: a hard test of face against flop."""

from __future__ import annotations

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

LABEL = "Sunny sky"

SUN = np.array([0.5, 0.62, 0.6]) / np.linalg.norm([0.5, 0.62, 0.6])
SUN_RADIUS_DEG = 2.0
SUN_RADIANCE = 900.0
SUN_COLOUR = (1.0, 0.92, 0.8)
ZENITH = (0.385, 0.605, 1.1)
HAZE = (0.75, 0.6, 0.35)
GROUND = (0.22, 0.19, 0.16)


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3)."""
    height = directions[:, 1:2].astype(np.float64)
    cosine = np.clip(directions.astype(np.float64) @ SUN, -1.0, 1.0)
    from_sun = np.degrees(np.arccos(cosine))[:, None]
    disc = SUN_RADIANCE * _step((SUN_RADIUS_DEG - from_sun) / 0.25)
    glow = 3.0 * np.exp(-from_sun / 12.0)
    haze = np.exp(-4.0 * np.maximum(height, 0.0)) * np.array(HAZE)
    sky = np.array(ZENITH) + haze + (disc + glow) * np.array(SUN_COLOUR)
    above = _step(height / 0.02)
    seen: FloatArray = above * sky + (1.0 - above) * np.array(GROUND)
    return seen.astype(np.float32)


def _step(x: FloatArray) -> FloatArray:
    """Logistic step from 0 to 1."""
    step: FloatArray = 0.5 + 0.5 * np.tanh(0.5 * x)
    return step
