from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import reflectance_to_lab
from paintlink_simulators import Panel
from paintlink_simulators.paint import (
    LABORATORY,
    TYPICAL,
    WAVELENGTHS_NM,
    WORKSHOP,
    Repeatability,
    noisy,
)

READINGS = 4000
LEVELS = [LABORATORY, TYPICAL, WORKSHOP]


def flat(factor: float, angles: int = 1) -> Panel:
    return Panel(15.0 + 30.0 * np.arange(angles), np.full((angles, 31), factor))


def readings(panel: Panel, repeatability: Repeatability) -> np.ndarray:
    rng = np.random.default_rng(1)
    return np.array([noisy(panel, rng, repeatability).factors for _ in range(READINGS)])


@pytest.mark.parametrize("level", LEVELS)
def test_gain_has_the_stated_deviation(level: Repeatability) -> None:
    means = readings(flat(1.0), level).mean(axis=2)

    expected = np.hypot(level.gain, level.floor / np.sqrt(31))
    assert means.std() == pytest.approx(expected, rel=0.05)
    assert means.mean() == pytest.approx(1.0, abs=5 * expected / np.sqrt(READINGS))


@pytest.mark.parametrize("level", LEVELS)
def test_floor_has_the_stated_deviation(level: Repeatability) -> None:
    factors = readings(flat(0.5), level)

    spread = (factors - factors.mean(axis=2, keepdims=True)).std()
    assert spread == pytest.approx(level.floor * np.sqrt(30 / 31), rel=0.02)


def test_angles_have_independent_gains() -> None:
    first, second = readings(flat(1.0, angles=2), TYPICAL).mean(axis=2).T

    assert abs(np.corrcoef(first, second)[0, 1]) < 5 / np.sqrt(READINGS)


@pytest.mark.parametrize(
    ("level", "difference"), [(LABORATORY, 0.03), (TYPICAL, 0.09), (WORKSHOP, 0.15)]
)
def test_white_tile_repeats_as_stated(level: Repeatability, difference: float) -> None:
    labs = reflectance_to_lab(WAVELENGTHS_NM, readings(flat(1.0), level)[:, 0])

    differences = np.linalg.norm(labs - (100, 0, 0), axis=1)
    assert differences.mean() == pytest.approx(difference, abs=0.01)


def test_black_never_reads_below_zero() -> None:
    factors = readings(flat(0.0), WORKSHOP)

    assert factors.min() == 0.0
    assert factors.max() > 0.0


def test_same_generator_state_gives_the_same_reading() -> None:
    first, second = (
        noisy(flat(0.4), np.random.default_rng(9)).factors for _ in range(2)
    )

    assert (first == second).all()
