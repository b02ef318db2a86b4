"""Angles, random formulas and Lab, for all tests of virtual paint."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import reflectance_to_lab
from paintlink.model import FloatArray
from paintlink_simulators.paint import WAVELENGTHS_NM, amounts, reflect
from paintlink_simulators.paint.toners import PIGMENT_COLUMNS, TONERS, Formula

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)


def lab_of(formula: Formula, angles_deg: tuple[float, ...] = ANGLES_DEG) -> FloatArray:
    """Lab D65/10 of one formula, shape (angles, 3)."""
    return reflectance_to_lab(
        WAVELENGTHS_NM, reflect(amounts([formula]), angles_deg)[0]
    )


def lightness(parts: FloatArray, angles_deg: tuple[float, ...]) -> FloatArray:
    """L* of many formulas, shape (n, angles)."""
    factors = reflect(parts, angles_deg)
    lab = reflectance_to_lab(WAVELENGTHS_NM, factors.reshape(-1, 31))
    return lab[:, 0].reshape(factors.shape[:2])


def random_amounts(count: int, seed: int, *, toners: int = 6) -> FloatArray:
    """Formulas of some toners each, drawn from all of the bench over three decades."""
    rng = np.random.default_rng(seed)
    taken = rng.random((count, len(TONERS))).argsort(axis=1) < toners
    parts = np.where(taken, 10.0 ** rng.uniform(-1.0, 2.0, taken.shape), 0.0)
    # Flop control alone is no paint.
    parts[:, 0] += 0.1 * (parts[:, :-1].sum(axis=1) == 0.0)
    return parts


@pytest.fixture(scope="session")
def any_formulas() -> FloatArray:
    return random_amounts(20_000, 1)


@pytest.fixture(scope="session")
def solid_formulas() -> FloatArray:
    parts = random_amounts(20_000, 2, toners=9)
    pigments = np.zeros_like(parts)
    pigments[:, PIGMENT_COLUMNS] = parts[:, PIGMENT_COLUMNS]
    pigments[pigments.sum(axis=1) == 0.0, 0] = 1.0
    return pigments
