"""Colours to learn from: virtual paints, and designs deformed from them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from paintbook.draw import effects, solids

from paintlink.color import reflectance_to_lab
from paintlink.model import FloatArray
from paintlink_simulators.paint import WAVELENGTHS_NM, reflect

ANGLES_DEG = np.array([15.0, 45.0, 110.0])
SOLID_SHARE = 0.2
BLOCK = 500

Rng = np.random.Generator


def formulas(count: int, seed: int) -> FloatArray:
    """Random formulas as the bundled library is chosen from, shape (n, toners)."""
    rng = np.random.default_rng(seed)
    solid = round(SOLID_SHARE * count)
    drawn = np.concatenate([solids(solid, rng), effects(count - solid, rng)])
    return drawn[rng.permutation(count)]


def colours(parts: FloatArray) -> FloatArray:
    """Lab D65/10 at 15, 45 and 110 degrees, shape (n, 3, 3)."""
    blocks = []
    for start in range(0, len(parts), BLOCK):
        factors = reflect(parts[start : start + BLOCK], ANGLES_DEG)
        flat = factors.reshape(-1, WAVELENGTHS_NM.size)
        blocks.append(reflectance_to_lab(WAVELENGTHS_NM, flat).reshape(-1, 3, 3))
    return np.concatenate(blocks)


def deformed(lab: FloatArray, rng: Rng) -> FloatArray:
    """A design: one paint's colour, bent in one of six ways, L* kept above 0."""
    design = DEFORMATIONS[rng.integers(len(DEFORMATIONS))](lab.copy(), rng)
    design[:, 0] = np.clip(design[:, 0], 0.3, 165.0)
    return design


def _more_chroma(lab: FloatArray, rng: Rng) -> FloatArray:
    lab[:, 1:] *= rng.uniform(1.0, 2.5)
    return lab


def _hue_travel(lab: FloatArray, rng: Rng) -> FloatArray:
    turn = np.radians(rng.uniform(10.0, 100.0) * rng.choice([-1.0, 1.0]))
    return _turned(lab, turn * np.array([0.0, 0.5, 1.0]))


def _brighter_face(lab: FloatArray, rng: Rng) -> FloatArray:
    strength = rng.uniform(0.0, 0.5)
    lab[:, 0] *= (1.0 + strength, 1.0, 1.0 - strength)
    return lab


def _other_middle(lab: FloatArray, rng: Rng) -> FloatArray:
    lab[1, 0] *= 1.0 + rng.uniform(-0.4, 0.4)
    return lab


def _chromatic_flop(lab: FloatArray, rng: Rng) -> FloatArray:
    strength = rng.uniform(0.0, 2.0)
    lab[:, 1:] *= 1.0 + strength * np.array([[0.0], [0.4], [1.0]])
    return lab


def _scattered(lab: FloatArray, rng: Rng) -> FloatArray:
    return lab + rng.normal(0.0, rng.uniform(1.0, 13.0), lab.shape)


def _turned(lab: FloatArray, turn: FloatArray) -> FloatArray:
    a, b = lab[:, 1].copy(), lab[:, 2].copy()
    lab[:, 1] = a * np.cos(turn) - b * np.sin(turn)
    lab[:, 2] = a * np.sin(turn) + b * np.cos(turn)
    return lab


DEFORMATIONS: tuple[Callable[[FloatArray, Rng], FloatArray], ...] = (
    _more_chroma,
    _hue_travel,
    _brighter_face,
    _other_middle,
    _chromatic_flop,
    _scattered,
)
