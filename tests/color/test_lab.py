from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.color import lab_to_lch, lab_to_xyz, white, xyz_to_lab

finite = st.floats(-150.0, 150.0)


def test_two_degree_white_shifts_neutrals():  # vector 6
    two_degrees = np.array([0.3127, 0.3290, 0.3583]) / 0.3290 * 100.0

    lab = xyz_to_lab(white("D65", "10"), two_degrees)

    assert lab == pytest.approx((100.0, -0.41, 0.98), abs=0.005)


@given(st.floats(-16.0, 170.0), finite, finite)
def test_xyz_and_back_keeps_lab(light, a, b):
    xyz = lab_to_xyz((light, a, b), white())

    assert xyz_to_lab(xyz, white()) == pytest.approx((light, a, b), abs=1e-9)


def test_dark_colours_follow_linear_toe():
    xyz = white() * 0.004

    assert xyz_to_lab(xyz, white()) == pytest.approx((0.004 * 903.2963, 0, 0), abs=1e-5)


def test_hue_angle_runs_counter_clockwise():
    lab = [[50, 3, 4], [50, -3, 0], [50, 0, -5], [50, 5, -1e-18]]

    lch = lab_to_lch(lab)

    assert lch[:, 1] == pytest.approx([5, 3, 5, 5])
    assert lch[:, 2] == pytest.approx([53.130102, 180, 270, 0])


def test_neutral_colour_has_no_hue():
    assert np.isnan(lab_to_lch((50, 0, 0))[2])
