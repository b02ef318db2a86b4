from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from paintlink.color import fit

THREE = (15.0, 45.0, 110.0)
FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
SIX = (-15.0, *FIVE)
LIMIT = (95.0 / 65.0) ** 2

channel = st.floats(-100.0, 150.0)


def lightness(*values: float) -> np.ndarray:
    return np.array([[value, 0.0, 0.0] for value in values])


def ends_in_vertex(vertex_deg: float, slope: float, floor: float) -> np.ndarray:
    rise = np.maximum(vertex_deg - np.array(SIX), 0.0) ** 2
    return np.outer(floor + slope * rise, [1.0, 0.3, -0.5])


@pytest.mark.parametrize(
    ("values", "vertex", "slope", "at_25", "at_75"),
    [
        pytest.param(
            (130, 61, 33), 79.8327, 0.0230772, 102.3846, 33.5390, id="vector-35"
        ),
        pytest.param(
            (86.55, 33.08, 9.88), 81.6795, 0.01724409, 65.2778, 10.6494, id="vector-36"
        ),
        pytest.param((40, 20, 20), 45.0, 20 / 900, 28.888889, 20.0, id="level-from-45"),
    ],
)
def test_clamped_curve_is_known(values, vertex, slope, at_25, at_75):
    curve = fit(THREE, lightness(*values), "clamped")

    assert curve.high_deg[0] == pytest.approx(vertex, abs=5e-5)
    assert curve.coefficients[0, 0] == pytest.approx(slope, abs=5e-8)
    assert curve([25, 75])[:, 0] == pytest.approx((at_25, at_75), abs=5.1e-5)
    assert curve(THREE)[:, 0] == pytest.approx(values, abs=1e-12)


def test_literal_curve_misses_the_flop():  # vector 37
    curve = fit(THREE, lightness(130, 61, 33), "paper_literal")

    assert curve.coefficients[:, 0] == pytest.approx(
        (0.01967611, -3.4805668, 177.781377), abs=5e-7
    )
    assert curve.high_deg[0] == pytest.approx(88.4465, abs=5e-5)
    assert curve([15, 45, 110, 150])[:, 0] == pytest.approx(
        (130, 61, 23.8594, 23.8594), abs=5e-5
    )


@pytest.mark.parametrize("model", ["clamped", "paper_literal"])
def test_concave_channel_follows_plain_parabola(model):  # vector 38
    curve = fit(THREE, lightness(50, 40, 10), model)

    assert curve.coefficients[:, 0] == pytest.approx(
        (-0.00134953, -0.25236167, 54.08906883), abs=5e-9
    )
    assert curve([25, 75, 180])[:, 0] == pytest.approx(
        (46.9366, 27.5709, 10.0), abs=5e-5
    )


def test_literal_curve_keeps_rising_channel():
    curve = fit(THREE, lightness(10, 20, 60), "paper_literal")

    assert curve(THREE)[:, 0] == pytest.approx((10, 20, 60))


def test_branches_meet_at_their_limit():  # vector 39
    below, above = (
        fit(THREE, lightness(LIMIT * factor, 1.0, 0.0), "clamped")
        for factor in (1 - 1e-9, 1 + 1e-9)
    )
    angles = np.linspace(15, 110, 40)

    assert above.high_deg[0] == pytest.approx(110.0, abs=1e-5)
    assert below(angles) == pytest.approx(above(angles), abs=1e-8)


@given(arrays(np.float64, (4, 3, 3), elements=channel))
def test_clamped_passes_through_all_three(lab):
    curve = fit(THREE, lab, "clamped")

    assert curve(THREE) == pytest.approx(lab, abs=1e-9)


@given(arrays(np.float64, (4, 3, 3), elements=channel))
def test_clamped_holds_the_measured_ends(lab):
    curve = fit(THREE, lab, "clamped")

    assert curve([-90, 0, 15]) == pytest.approx(lab[:, [0, 0, 0]], abs=1e-9)
    assert curve([110, 150, 180]) == pytest.approx(lab[:, [2, 2, 2]], abs=1e-9)


@given(channel, st.floats(0.0, 100.0), st.floats(0.0, 100.0))
def test_clamped_never_dips_below_flop(flop, drop, first_drop):
    lab = lightness(flop + drop + first_drop, flop + drop, flop)

    values = fit(THREE, lab, "clamped")(np.linspace(0, 180, 91))[:, 0]

    assert values.min() == pytest.approx(flop, abs=1e-9)


def test_many_paints_equal_one_by_one():
    rng = np.random.default_rng(7)
    for angles in (THREE, FIVE):
        lab = rng.uniform(0, 100, (50, len(angles), 3))
        asked = np.linspace(0, 180, 12).reshape(3, 4)

        together = fit(angles, lab, "clamped")(asked)

        alone = [fit(angles, paint, "clamped")(asked) for paint in lab]
        assert together.shape == (50, 3, 4, 3)
        assert together == pytest.approx(np.array(alone), abs=1e-9)


@pytest.mark.parametrize("vertex_deg", [52, 80, 100])
def test_least_squares_finds_the_vertex(vertex_deg):
    truth = ends_in_vertex(vertex_deg, 0.02, 12.0)

    curve = fit(FIVE, truth[1:], "clamped")

    assert curve.high_deg == pytest.approx(float(vertex_deg))
    assert curve(FIVE) == pytest.approx(truth[1:], abs=1e-9)


def test_least_squares_keeps_open_parabola():
    truth = ends_in_vertex(140, 0.01, 5.0)

    curve = fit(FIVE, truth[1:], "clamped")

    assert curve(FIVE) == pytest.approx(truth[1:], abs=1e-9)
    assert curve(180.0) == pytest.approx(truth[-1], abs=1e-9)


def test_least_squares_never_turns_up_again():
    u_shaped = [12.0 + 0.02 * (angle - 100.0) ** 2 for angle in FIVE]

    values = fit(FIVE, lightness(*u_shaped), "clamped")(np.linspace(15, 180, 100))

    assert (np.diff(values[:, 0]) <= 0.0).all()
    assert values[0, 0] - values[-1, 0] > 100.0


@pytest.mark.parametrize("model", ["clamped", "paper_literal"])
def test_far_side_of_mirror_is_left_out(model):
    near = np.random.default_rng(3).uniform(0, 90, (5, 3))
    with_far = np.r_[[[200.0, 50, 50]], near]

    asked = np.linspace(0, 150, 31)
    six, five = fit(SIX, with_far, model), fit(FIVE, near, model)

    assert np.array_equal(six(asked), five(asked))
    assert six.angles_deg == SIX


@pytest.mark.parametrize("angles", [THREE, FIVE, SIX, (25.0, 45.0, 75.0)])
@pytest.mark.parametrize("model", ["clamped", "paper_literal", "pchip"])
def test_solid_has_a_constant_curve(model, angles):
    solid = np.full((len(angles), 3), (43.21, 56.7, -35.9))

    values = fit(angles, solid, model)(np.linspace(-90, 180, 100))

    assert np.array_equal(values, np.full((100, 3), (43.21, 56.7, -35.9)))


def test_clamped_accepts_another_angle_set():
    lab = lightness(70, 40, 30)

    curve = fit((25, 45, 75), lab, "clamped")

    assert curve([25, 45, 75, 110])[:, 0] == pytest.approx((70, 40, 30, 30))
    assert 45.0 < curve.high_deg[0] < 75.0
