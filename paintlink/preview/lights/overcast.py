"""Cloud from horizon to horizon: soft light without a lamp."""

from __future__ import annotations

import numpy as np

from paintlink.preview.arrays import Float32Array

LABEL = "Overcast"

GROUND = 0.12


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3); three times brighter above than aside.

    References
    ----------
    Moon, Spencer, Illumination from a non-uniform sky (1942); ISO 15469, CIE standard
    overcast sky.
    """
    height = directions[:, 1]
    sky = (1.0 + 2.0 * np.maximum(height, 0.0)) / 3.0
    above = 0.5 + 0.5 * np.tanh(height / 0.05)
    level = above * sky + (1.0 - above) * GROUND
    return np.repeat(level[:, None], 3, axis=1).astype(np.float32)
