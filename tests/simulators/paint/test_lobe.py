from __future__ import annotations

import numpy as np
import pytest

from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.lobe import tilt_density


@pytest.mark.parametrize("flake", FLAKES, ids=lambda flake: flake.code)
def test_every_flake_lies_somewhere(flake) -> None:
    slope = np.concatenate([[0.0], np.geomspace(1e-6, 1e7, 400_000)])
    tilt = np.arctan(slope)

    density = tilt_density(tilt, np.radians(flake.spread_deg), flake.tail)

    ring = 2 * np.pi * np.sin(tilt) * density
    assert np.trapezoid(ring, tilt) == pytest.approx(1.0, abs=1e-4)


def test_high_powers_become_a_gaussian_of_the_slope() -> None:
    tilt, width = np.radians(np.arange(0.0, 20.0)), np.radians(5.0)
    slope = np.tan(tilt)

    gaussian = np.exp(-(slope**2) / (2 * width**2)) / (2 * np.pi * width**2)
    expected = gaussian / np.cos(tilt) ** 3

    assert tilt_density(tilt, width, 1e6) == pytest.approx(expected, rel=1e-3)


def test_density_does_not_care_for_the_side() -> None:
    assert tilt_density(-0.1, 0.08, 2.0) == tilt_density(0.1, 0.08, 2.0)
