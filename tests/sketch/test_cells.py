from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.sketch.cells import mean_cells, median_cells, pixels
from paintlink.sketch.transfer import reflected_lab


def in_one_cell(values: list[float]):
    encoded = np.repeat(np.array(values)[:, np.newaxis], 3, axis=1)
    size = len(values)
    return pixels(np.full(size, 45.5), np.full(size, 0.5), encoded, 1.0)


@settings(deadline=None)
@given(st.lists(st.integers(0, 255), min_size=4, max_size=9))
def test_cells_hold_the_median_of_encoded_values(codes):
    values = [code / 255.0 for code in codes]

    cells = median_cells(in_one_cell(values))

    middle = reflected_lab(np.full(3, np.median(values)), np.array(0.5), 1.0)
    assert cells.lab[0] == pytest.approx(middle, abs=0.02)
    assert cells.count.tolist() == [len(codes)]


def test_medians_of_neighbouring_cells_stay_apart():
    theta = np.repeat([20.5, 21.5, 90.5], [4, 5, 3])
    encoded = np.repeat([[0.0] * 3, [1.0] * 3, [0.5] * 3], [4, 5, 3], axis=0)

    cells = median_cells(pixels(theta, np.ones(12), encoded, 1.0))

    assert cells.theta_deg == pytest.approx([20.5, 21.5])
    assert cells.lab[:, 0] == pytest.approx([0.0, 100.0], abs=1e-4)


def test_means_leave_strays_out():
    one = in_one_cell([0.5, 0.5, 0.5, 1.0])

    cells = mean_cells(one, np.array([True, True, True, False]))

    right = reflected_lab(np.full(3, 0.5), np.array(0.5), 1.0)
    assert cells.lab[0] == pytest.approx(right)
    assert cells.count.tolist() == [3]


@pytest.mark.parametrize(("size", "left"), [(3, 2), (13, 3)])
def test_cells_of_mostly_strays_are_dropped(size, left):
    inlier = np.arange(size) < left

    assert mean_cells(in_one_cell([0.5] * size), inlier).count.size == 0


def test_dark_cells_weigh_less():
    phi = np.repeat([1.0, 0.125], 4)

    cells = median_cells(pixels(np.full(8, 30.0), phi, np.full((8, 3), 0.3), 1.0))

    assert sorted(cells.weight.tolist()) == pytest.approx([1.0, 4.0])
