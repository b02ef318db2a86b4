"""The search told literally: every paint, one angle after the other, then sorted."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from paintlink.color import FORMULAS
from paintlink.model import FloatArray

Mask = NDArray[np.bool_]


def brute_totals(
    formula: str, lab: FloatArray, target: FloatArray, angles_deg: tuple[float, ...]
) -> FloatArray:
    """Totals of paints, Lab (n, angles, 3)."""
    total = np.zeros(len(lab))
    for at, angle in enumerate(angles_deg):
        total += FORMULAS[formula](lab[:, at], target[at], angle)
    return total


def brute_order(total: FloatArray, ids: NDArray[np.int64]) -> NDArray[np.int64]:
    """All positions, by total, ties by id."""
    return np.lexsort((ids, total))


def paints(rng: Generator, count: int, angles: int) -> FloatArray:
    """Lab (n, angles, 3) on a hundredths grid, clustered, with exact duplicates."""
    centres = rng.uniform((5, -60, -60), (95, 60, 60), (max(count // 8, 1), 3))
    face_to_flop = np.linspace(1.0, -1.0, angles)[:, np.newaxis]
    travel = rng.normal(0.0, (12.0, 6.0, 6.0), (count, 1, 3)) * face_to_flop
    lab = centres[rng.integers(0, len(centres), count)][:, np.newaxis] + travel
    lab = np.round(lab + rng.normal(0.0, 0.8, lab.shape), 2)
    copies = rng.integers(0, count, count // 8)
    lab[rng.integers(0, count, count // 8)] = lab[copies]
    full_precision = rng.random() < 0.2
    return lab + 1.0 / 3.0 if full_precision else lab


def targets(rng: Generator, lab: FloatArray) -> FloatArray:
    """One of the hard kinds of target for these paints, shape (angles, 3)."""
    paint = lab[rng.integers(len(lab))]
    kind = rng.integers(7)
    if kind == 0:
        return paint.copy()
    if kind == 1:
        return paint * (1.0, 1.7, 1.7) + (8.0, 0.0, 0.0)
    if kind == 2:
        return rng.uniform((-5, -120, -120), (165, 120, 120), paint.shape)
    if kind == 3:
        hue = np.radians(rng.uniform(215.0, 335.0))
        chroma = rng.uniform(30.0, 120.0, (len(paint), 1))
        return np.hstack([paint[:, :1], chroma * (np.cos(hue), np.sin(hue))])
    if kind == 4:
        return np.hstack([paint[:, :1], rng.normal(0.0, 0.02, (len(paint), 2))])
    if kind == 5:
        return np.round(paint + rng.integers(-2, 3, paint.shape) * 0.25, 2)
    return np.round(paint + rng.normal(0.0, 0.7, paint.shape), 3)
