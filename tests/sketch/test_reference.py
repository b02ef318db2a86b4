from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.cells import Cells, pixels
from paintlink.sketch.reference import profile, without_strays
from paintlink.sketch.transfer import shown

RNG = np.random.default_rng(7)
THETA = RNG.uniform(12.0, 140.0, 40_000)
PHI = RNG.uniform(0.2, 1.0, 40_000)


def steep(theta_deg: np.ndarray) -> np.ndarray:
    lightness = 20.0 + 70.0 * np.exp(-theta_deg / 12.0)
    return np.stack([lightness, 0.3 * lightness, -10.0 + 0.0 * lightness], axis=-1)


def test_stray_strokes_are_found_and_the_steep_face_kept():
    encoded = shown(steep(THETA), PHI, 0.5)
    stray = RNG.random(THETA.size) < 0.2
    encoded[stray] = (0.9, 0.1, 0.8)

    inlier, cells = without_strays(pixels(THETA, PHI, encoded, 0.5))

    assert not (inlier & stray).any()
    assert inlier[~stray].mean() > 0.95
    assert inlier[~stray & (THETA < 16.0)].mean() > 0.8
    assert np.abs(cells.lab - steep(cells.theta_deg)).max() < 1.0


def test_profile_is_the_weighted_median_of_its_bin():
    lab = np.array([[10.0] * 3, [50.0] * 3, [90.0] * 3])
    cells = Cells(np.full(3, 31.0), np.ones(3), lab, np.array([1, 1, 3]))

    assert profile(cells)(np.array([31.0]))[0] == pytest.approx([90.0] * 3)


def test_profile_runs_on_below_its_first_bin():
    lab = np.array([[60.0, 6.0, 0.0], [50.0, 5.0, 0.0], [50.0, 5.0, 0.0]])
    cells = Cells(np.array([20.0, 25.0, 60.0]), np.ones(3), lab, np.ones(3, int))

    found = profile(cells)(np.array([15.0, 22.5, 90.0]))

    assert found[:, 0] == pytest.approx([70.0, 55.0, 50.0])


def test_no_cells_leave_no_inliers():
    few = pixels(THETA[:3], PHI[:3], np.full((3, 3), 0.5), 1.0)

    inlier, cells = without_strays(few)

    assert not inlier.any()
    assert cells.count.size == 0
