"""A car photographer's studio, neutral: dark walls, softboxes, a bright floor."""

from __future__ import annotations

import numpy as np

from paintlink.preview.arrays import Float32Array
from paintlink.preview.softbox import Softbox

LABEL = "Studio"

LAMPS = (
    Softbox((0.20, 0.86, 0.52), 0.80, 0.20, 8.0, gradient=0.6),
    Softbox((-0.95, 0.20, 0.22), 0.12, 0.62, 6.0),
    Softbox((0.98, 0.10, -0.20), 0.10, 0.55, 5.0),
    Softbox((0.0, 0.90, -0.52), 0.75, 0.06, 5.0, up=(0.0, 0.0, 1.0)),
    Softbox((-0.62, 0.16, 0.75), 0.50, 0.30, 1.3, edge=0.1),
)


def radiance(directions: Float32Array) -> Float32Array:
    """Linear sRGB radiance, shape (n, 3)."""
    height = directions[:, 1]
    walls = 0.17 + 0.07 * np.tanh((height - 0.1) * 2.5)
    floor = 0.225 * (1.0 - np.tanh((height + 0.06) * 16.0))
    seen = walls + floor * np.exp(1.3 * np.minimum(height, 0.0))
    for lamp in LAMPS:
        seen += lamp.seen_along(directions)
    return np.repeat(seen[:, None], 3, axis=1)
