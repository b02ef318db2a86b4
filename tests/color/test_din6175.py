from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.color import din6175
from paintlink.color.din6175 import din6175_weights
from paintlink.errors import SpecError

ANGLES = [15, 25, 45, 75, 110]
CHROMATIC = ((60, 30, -20), (61, 31, -20))
NEUTRAL = ((60, 1, -2), (61, 1.5, -2))


@pytest.mark.parametrize(
    ("pair", "expected"),
    [
        pytest.param(
            CHROMATIC, [0.5730, 0.8997, 1.2118, 1.5166, 1.5857], id="vector-19"
        ),
        pytest.param(NEUTRAL, [0.7771, 0.8246, 0.8929, 0.9526, 0.9919], id="vector-21"),
    ],
)
def test_difference_follows_known_angles(pair, expected):
    assert din6175(*pair, ANGLES) == pytest.approx(expected, abs=5.1e-5)


def test_chromatic_weights_are_known():  # vector 20
    weights = din6175_weights(*CHROMATIC, 45)

    assert weights == pytest.approx((1.8667, 1.1098, 0.7, 0.0), abs=5e-5)


def test_neutral_weights_are_known():  # vector 22
    weights = din6175_weights(*NEUTRAL, 15)

    assert weights == pytest.approx((3.2667, 0.8158, 0.7597, 1.0), abs=5e-5)


def test_far_side_counts_as_near_side():  # vector 23
    assert din6175(*CHROMATIC, -15) == din6175(*CHROMATIC, 15)


def test_mirror_direction_is_refused():  # vector 23
    with pytest.raises(SpecError, match="no tolerance at 0 degrees"):
        din6175(*CHROMATIC, [15, 0, 110])


def test_noisy_black_still_has_tolerance():
    difference = din6175((-0.01, 0, 0), (0.5, 0, 0), 110)

    assert difference == pytest.approx(din6175((0, 0, 0), (0.51, 0, 0), 110))


@given(st.floats(0, 150), st.floats(-400, 400), st.floats(-400, 400))
def test_saturated_colours_do_not_overflow(light, a, b):
    difference = din6175((light, a, b), (light + 1, a, b), ANGLES)

    assert np.isfinite(difference).all()
    assert (difference > 0).all()
