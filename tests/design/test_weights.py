from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.design.weights import STEEPEST_REST, face_weight, flop_weight, rate

RED_L = (52.0, 34.0, 20.0)


@pytest.mark.parametrize(
    ("vertex_deg", "at_25", "at_45", "at_75"),
    [
        (50, 0.5102, 0.0204, 0.0),
        (60, 0.6049, 0.1111, 0.0),
        (70, 0.6694, 0.2066, 0.0),
        (80, 0.7160, 0.2899, 0.0059),
        (90, 0.7511, 0.3600, 0.0400),
        (100, 0.7785, 0.4187, 0.0865),
        (110, 0.8006, 0.4681, 0.1357),
    ],
)
def test_face_weight_falls_to_the_vertex(
    vertex_deg: float, at_25: float, at_45: float, at_75: float
) -> None:
    weight = face_weight(np.array([15.0, 25.0, 45.0, 75.0, 110.0]), vertex_deg)

    np.testing.assert_allclose(weight, [1.0, at_25, at_45, at_75, 0.0], atol=5e-5)


def test_flop_weight_rises_to_one() -> None:
    weight = flop_weight(np.array([0.0, 15.0, 62.5, 110.0, 150.0]))

    assert weight.tolist() == [0.0, 0.0, 0.25, 1.0, 1.0]


def test_rate_of_red_gives_its_samples_at_five_angles() -> None:
    y15, _, y110 = RED_L
    vertex_deg = rate(*RED_L).vertex_deg
    assert vertex_deg is not None

    weight = face_weight(np.array([15.0, 25.0, 45.0, 75.0, 110.0]), vertex_deg)

    expected = [52.0, 45.1849, 34.0, 23.336, 20.0]
    np.testing.assert_allclose(y110 + (y15 - y110) * weight, expected, atol=5e-5)


@given(st.floats(45.001, 110.0))
@settings(deadline=None)
def test_vertex_and_rest_are_the_same_thing(vertex_deg: float) -> None:
    middle = 20.0 + 32.0 * float(face_weight(np.array(45.0), vertex_deg))

    found = rate(52.0, middle, 20.0).vertex_deg

    assert found == pytest.approx(vertex_deg, abs=1e-9)


@pytest.mark.parametrize(
    ("samples", "says"),
    [
        ((40.0, 40.0, 40.0), "no travel"),
        ((40.0, 55.0, 40.0), "no travel"),
        ((50.0, 20.0, 20.0), "levels off at 45.0°"),
        ((50.0, 40.0, 20.0), "levels off beyond 110°"),
        ((20.0, 40.0, 50.0), "levels off at 110|levels off at"),
        ((50.0, 10.0, 20.0), "not monotone"),
        ((50.0, 60.0, 20.0), "not monotone"),
    ],
)
def test_rate_is_told_in_words(samples: tuple[float, float, float], says: str) -> None:
    assert any(str(rate(*samples)).startswith(text) for text in says.split("|"))


def test_slowest_clamped_rate_levels_off_at_110() -> None:
    assert rate(1.0, STEEPEST_REST, 0.0).vertex_deg == pytest.approx(110.0)
    assert rate(1.0, STEEPEST_REST + 1e-9, 0.0).vertex_deg is None
