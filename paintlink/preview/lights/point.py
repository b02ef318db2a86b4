"""One small far lamp and nothing else: every angle by itself."""

from __future__ import annotations

import numpy as np

from paintlink.preview.arrays import Float32Array

LABEL = "Point light"

LAMP = np.array([-0.35, 0.65, 0.675]) / np.linalg.norm([-0.35, 0.65, 0.675])
RADIUS_DEG = 2.0


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3)."""
    cosine = np.clip(directions.astype(np.float64) @ LAMP, -1.0, 1.0)
    inside = (RADIUS_DEG - np.degrees(np.arccos(cosine))) / 0.25
    level = 0.5 + 0.5 * np.tanh(0.5 * np.clip(inside, -60.0, 60.0))
    level = np.where(level < 1e-6, 0.0, level)
    return np.repeat(level[:, None], 3, axis=1).astype(np.float32)
