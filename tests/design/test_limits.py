from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.color import lab_to_xyz, white
from paintlink.design.limits import (
    along,
    possible,
    room,
    share,
    with_possible_chroma,
)
from paintlink.model import FloatArray
from tests.design.conftest import RED

lightness = st.floats(0.0, 170.0)
opponent = st.floats(-250.0, 250.0)
colors = st.tuples(lightness, opponent, opponent).map(np.array)
reachable = colors.map(lambda lab: with_possible_chroma(lab)[0])


@given(colors)
@settings(deadline=None)
def test_limits_are_those_of_xyz(lab: FloatArray) -> None:
    _, x_room, z_room = room(lab)[:3]
    xyz = lab_to_xyz(lab, white("D65", "10"))

    for left, amount in ((x_room, xyz[0]), (z_room, xyz[2])):
        if abs(left) > 1e-9:
            assert (left > 0.0) == (amount > 0.0)


@pytest.mark.parametrize(
    ("a_per_l", "b_per_l"), [(-500.0 / 116.0, 0.0), (0.0, 200.0 / 116.0)]
)
def test_limits_lie_where_x_or_z_is_zero(a_per_l: float, b_per_l: float) -> None:
    edge = np.array([10.0, 10.0 * a_per_l, 10.0 * b_per_l])

    xyz = lab_to_xyz(edge, white("D65", "10"))

    assert xyz.min() == pytest.approx(0.0, abs=1e-12)
    assert possible(edge * (1.0, 0.999, 0.999))
    assert not possible(edge * (1.0, 1.001, 1.001))


@given(reachable, colors)
@settings(deadline=None)
def test_share_is_the_largest_that_stays_possible(
    lab: FloatArray, target: FloatArray
) -> None:
    part = share(lab, target)

    assert possible(along(lab, target, part))
    if part < 1.0:
        # A little further is outside, by more than the tolerance.
        beyond = lab + part * (target - lab) + 1e-3 * (target - lab)
        assert room(beyond).min() < 0.0


@given(reachable, reachable)
@settings(deadline=None)
def test_way_between_possible_colors_is_never_limited(
    lab: FloatArray, target: FloatArray
) -> None:
    assert share(lab, target) == 1.0


def test_whole_way_ends_exactly_at_the_target() -> None:
    target = np.array(RED) * 0.3

    assert along(np.array(RED), target, 1.0) is target


@given(colors)
@settings(deadline=None)
def test_reduced_chroma_keeps_lightness_and_hue(lab: FloatArray) -> None:
    reduced, factor = with_possible_chroma(lab)

    assert possible(reduced)
    np.testing.assert_allclose(reduced[1:], factor * lab[1:], atol=1e-10)
    assert reduced[0] == pytest.approx(lab[0])


def test_missing_values_are_not_possible() -> None:
    assert not possible([np.nan, 0.0, 0.0])
    assert not possible([50.0, np.inf, 0.0])


def test_black_and_the_brightest_grey_are_possible() -> None:
    assert possible([0.0, 0.0, 0.0])
    assert possible([170.0, 0.0, 0.0])
    assert not possible([170.1, 0.0, 0.0])
    assert not possible([-0.1, 0.0, 0.0])
