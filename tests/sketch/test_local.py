from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.cells import Cells
from paintlink.sketch.local import local_value


def cells_of(lab_at, theta: np.ndarray | None = None) -> Cells:
    theta = np.arange(12.5, 140.0) if theta is None else theta
    return Cells(
        theta, np.full(theta.shape, 0.7), lab_at(theta), np.full(theta.size, 50)
    )


def quadratic(theta: np.ndarray) -> np.ndarray:
    t = np.minimum(theta, 110.0) / 110.0
    return np.stack([80 - 90 * t + 40 * t * t, 5 * t, -9 + t * t], axis=-1)


@pytest.mark.parametrize("angle", [15.0, 25.0, 45.0, 75.0, 110.0])
def test_a_quadratic_held_at_110_is_met_exactly(angle):
    value = local_value(cells_of(quadratic), angle)

    assert value.lab == pytest.approx(quadratic(np.array(angle)), abs=1e-10)
    assert value.uncertainty == pytest.approx([0.05] * 3)


def test_compression_makes_values_less_certain():
    value = local_value(cells_of(quadratic), 45.0, lossy=True)

    assert value.uncertainty == pytest.approx([0.15] * 3)


def test_uncertainty_covers_the_error_of_noise():
    rng = np.random.default_rng(11)
    scores = []
    for _ in range(300):
        lab = rng.normal(0.0, 1.0, (2000, 3))
        theta = rng.uniform(12.0, 140.0, 2000)
        value = local_value(cells_of(lambda _, lab=lab: lab + 50.0, theta), 45.0)
        scores.append((value.lab - 50.0) / value.uncertainty)

    assert 0.4 < np.median(np.abs(scores)) < 0.75
    assert np.mean(np.abs(scores) < 2.0) > 0.93


def test_lightness_never_falls_below_black():
    value = local_value(cells_of(lambda theta: quadratic(theta) - 200.0), 45.0)

    assert value.lab[0] == 0.0
    assert value.lab[1] < 0.0
