from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.cells import Cells
from paintlink.sketch.travel import travel_curve

ANGLES = (15.0, 45.0, 110.0)
THETA = np.arange(12.5, 140.0)


def cells_of(lab: np.ndarray) -> Cells:
    return Cells(THETA, np.full(THETA.size, 0.6), lab, np.full(THETA.size, 20))


def test_each_channel_finds_its_own_vertex():
    vertices, slopes = np.array([50.0, 70.0, 90.0]), np.array([0.02, -0.01, 0.005])
    rise = np.maximum(vertices - THETA[:, np.newaxis], 0.0) ** 2

    curve = travel_curve(cells_of(30.0 + slopes * rise), ANGLES)

    assert curve.high_deg.tolist() == vertices.tolist()
    assert curve([15.0])[0] == pytest.approx(30.0 + slopes * (vertices - 15.0) ** 2)
    assert curve([110.0, 170.0]) == pytest.approx(np.full((2, 3), 30.0))


def test_travel_that_never_levels_off_follows_the_parabola():
    t = np.minimum(THETA, 110.0)
    lab = np.repeat((80.0 - 0.1 * t - 0.002 * t * t)[:, np.newaxis], 3, axis=1)

    curve = travel_curve(cells_of(lab), ANGLES)

    assert curve([45.0])[0] == pytest.approx([80.0 - 4.5 - 4.05] * 3)
    assert curve.high_deg.tolist() == [110.0] * 3


def test_solid_paint_has_a_level_curve():
    curve = travel_curve(cells_of(np.full((THETA.size, 3), 42.0)), ANGLES)

    assert curve([0.0, 60.0, 180.0]) == pytest.approx(np.full((3, 3), 42.0))
