"""Invented texture numbers, so that simulated instruments have some to report.

No public formula exists; these only rise with flake size and with the share of metal.
Never compare them with the numbers of an instrument maker.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import FloatArray
from paintlink_simulators.paint import base
from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.toners import FLAKE_COLUMNS, PIGMENT_COLUMNS

TEXTURE: tuple[tuple[str, float | None], ...] = (
    ("sparkle intensity", 15.0),
    ("sparkle intensity", 45.0),
    ("sparkle intensity", 75.0),
    ("graininess", None),
)
"""Name and aspecular angle of each number."""

SCALES = np.array([3.6, 1.9, 0.8, 1.2])
SIZE_PER_UM = 0.15


def texture(amounts: ArrayLike) -> FloatArray:
    """Sparkle at 15, 45 and 75 degrees and graininess, shape (n, 4); solids have 0.

    c · ln(1 + 0.15 d) · √(metal / (flakes + pigment)) with the mean diameter d of the
    flakes in µm.
    """
    parts = np.atleast_2d(np.asarray(amounts, dtype=np.float64))
    flakes = parts[:, FLAKE_COLUMNS] * base.of_flakes("area")[:, 0]
    total = flakes.sum(axis=1)
    metal = flakes @ np.array([flake.kind == "aluminium" for flake in FLAKES])
    pigments = parts[:, PIGMENT_COLUMNS]
    beam = pigments @ (base.pigment_absorption() / 2.0 + base.pigment_scattering())
    size = (
        flakes @ base.of_flakes("diameter_um")[:, 0] / np.where(total > 0.0, total, 1.0)
    )
    shine = np.sqrt(metal / (total + beam.mean(axis=1)))
    return np.outer(np.log1p(SIZE_PER_UM * size) * shine, SCALES)
