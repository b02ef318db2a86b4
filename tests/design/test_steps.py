"""The formulas, held against hand-computed colours and against each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from paintlink.color import (
    chroma_index,
    flop_index,
    hue_shift_index,
    lab_to_lch,
    lab_to_xyz,
    white,
)
from paintlink.model import ColorSpec, Lab, Sample
from tests.design.conftest import FIVE, RED, RED_AT_FIVE, after, applied, make_spec

GOLD = (82.0, 12.0, 62.0)
NEUTRAL = ((80.0, 0.0, 0.0), (50.0, 0.0, 0.0), (30.0, 0.0, 0.0))

factors = st.floats(0.05, 1.3)
turns = st.floats(-360.0, 360.0)


@pytest.mark.parametrize(
    ("step", "values", "expected"),
    [
        (
            "rotate-hue",
            {"angle_deg": 120.0},
            [(52, -63.641, 30.2295), (34, -49.9808, 26.5692), (20, -34.3205, 19.4449)],
        ),
        (
            "exposure",
            {"stops": 1.0},
            [
                (69.6746, 73.0754, 50.3968),
                (46.9961, 60.4762, 37.7976),
                (29.3572, 42.8373, 25.1984),
            ],
        ),
        ("travel", {"factor": 1.5}, [(61, 58, 40), (34, 48, 30), (13, 34, 20)]),
        (
            "tint-flop",
            {"color": (10.0, 5.0, -30.0), "amount": 0.5},
            [(52, 58, 40), (32.8033, 45.856, 27.0083), (15, 19.5, -5)],
        ),
        (
            "tint-highlight",
            {"color": GOLD, "amount": 0.35, "vertex_deg": 60.0},
            [(62.5, 41.9, 47.7), (35.8667, 46.6, 31.2444), (20, 34, 20)],
        ),
        (
            "tint-highlight",
            {"color": GOLD, "amount": 0.6, "vertex_deg": 60.0},
            [(70, 30.4, 53.2), (37.2, 45.6, 32.1333), (20, 34, 20)],
        ),
        ("set-travel", {"vertex_deg": 60.0}, [RED[0], (23.5556, 48, 30), RED[2]]),
    ],
)
def test_red_after_each_step(
    step: str, values: dict[str, object], expected: ArrayLike
) -> None:
    made = applied(step, **values)

    assert made.share == 1.0
    np.testing.assert_allclose(made.state.lab, expected, atol=6e-5)


@pytest.mark.parametrize(("amount", "index"), [(0.35, 7.95), (0.6, 9.22)])
def test_gold_highlight_raises_the_flop_index(amount: float, index: float) -> None:
    lab = after("tint-highlight", color=GOLD, amount=amount, vertex_deg=60.0)

    assert flop_index(lab) == pytest.approx(index, abs=5e-3)


def test_set_travel_puts_five_samples_on_the_curve() -> None:
    lab = after("set-travel", RED_AT_FIVE, vertex_deg=80.0)

    np.testing.assert_allclose(
        lab[:, 0], [52.0, 20 + 32 * 0.7160, 20 + 32 * 0.2899, 20 + 32 * 0.0059, 20.0],
        atol=2e-3,
    )  # fmt: skip
    assert np.array_equal(lab[:, 1:], np.array(RED_AT_FIVE)[:, 1:])


def test_set_travel_changes_no_bit_of_the_ends() -> None:
    rng = np.random.default_rng(3)

    for _ in range(100):
        lab = rng.uniform((20, -5, -5), (90, 5, 5), (3, 3))
        curve = after("set-travel", lab, vertex_deg=77.7, channels="Lab")
        assert np.array_equal(curve[[0, 2]], lab[[0, 2]])


def test_darkening_too_far_stops_at_the_limit() -> None:
    made = applied("darken", amount=40.0)

    b_limit = 200.0 / 116.0 * made.state.lab[2, 0]
    assert made.share == pytest.approx(0.21, abs=5e-5)
    assert made.state.lab[2, 2] == pytest.approx(b_limit, abs=1e-12)


def test_hue_turn_by_360_degrees_changes_no_bit() -> None:
    lab = np.random.default_rng(1).normal((50, 0, 0), (5, 20, 10), (3, 3))

    for turn in (360.0, -360.0, 0.0):
        assert np.array_equal(after("rotate-hue", lab, angle_deg=turn), lab)


def test_twelve_turns_of_30_degrees_come_back() -> None:
    lab = np.array(RED) * (1.0, 0.3, 0.3)

    turned = lab
    for _ in range(12):
        turned = after("rotate-hue", turned, angle_deg=30.0)

    np.testing.assert_allclose(turned, lab, atol=1e-13)


def test_four_quarter_turns_change_no_bit() -> None:
    lab = np.array(RED) * (1.0, 0.3, 0.3)

    turned = lab
    for _ in range(4):
        turned = after("rotate-hue", turned, angle_deg=90.0)

    assert np.array_equal(turned, lab)


@given(turns)
@settings(deadline=None)
def test_neutral_has_no_hue_to_turn(angle_deg: float) -> None:
    lab = after("rotate-hue", NEUTRAL, angle_deg=angle_deg)

    assert lab.tobytes() == np.array(NEUTRAL).tobytes()


@given(turns)
@settings(deadline=None)
def test_hue_turn_keeps_all_indices(angle_deg: float) -> None:
    soft = np.array(RED) * (1.0, 0.3, 0.3)

    lab = after("rotate-hue", soft, angle_deg=angle_deg)

    assert flop_index(lab) == flop_index(soft)
    assert chroma_index(lab) == pytest.approx(chroma_index(soft), abs=1e-12)
    assert hue_shift_index(lab) == pytest.approx(hue_shift_index(soft), abs=1e-12)


def test_hue_turn_out_of_reach_keeps_the_angle() -> None:
    dark = ((20.0, 25.0, -60.0), (10.0, 20.0, -40.0), (6.0, 12.0, -20.0))

    made = applied("rotate-hue", dark, angle_deg=150.0)

    before, turned = lab_to_lch(dark), lab_to_lch(made.state.lab)
    np.testing.assert_allclose((turned[:, 2] - before[:, 2]) % 360.0, 150.0)
    np.testing.assert_allclose(turned[:, 1] / before[:, 1], made.share)
    assert made.share < 1.0
    assert "chroma is kept to" in made.notes[0]


@given(st.floats(-3.0, 0.5))
@settings(deadline=None)
def test_exposure_scales_reflectance(stops: float) -> None:
    made = applied("exposure", stops=stops)

    daylight = white("D65", "10")
    ratio = lab_to_xyz(made.state.lab, daylight) / lab_to_xyz(RED, daylight)
    assert made.share == 1.0
    np.testing.assert_allclose(ratio, 2.0**stops, rtol=1e-9)


@pytest.mark.parametrize("stops", [0.7, -2.0])
def test_opposite_exposure_comes_back(stops: float) -> None:
    lab = after("exposure", after("exposure", stops=stops), stops=-stops)

    np.testing.assert_allclose(lab, RED, atol=5e-13)


def test_lighten_is_undone_by_darken() -> None:
    lab = after("darken", after("lighten", amount=10.0), amount=10.0)

    np.testing.assert_allclose(lab, RED, atol=1e-13)


def test_lighten_keeps_what_divides_the_flop_index() -> None:
    lab = after("lighten", amount=10.0)

    assert lab[0, 0] - lab[2, 0] == RED[0][0] - RED[2][0]


def test_chroma_factor_scales_every_chroma() -> None:
    lab = after("chroma", factor=0.5)

    assert np.array_equal(lab, np.array(RED) * (1.0, 0.5, 0.5))


def test_no_chroma_leaves_no_hue() -> None:
    grey = after("chroma", factor=0.0)

    assert np.all(np.isnan(lab_to_lch(grey)[:, 2]))
    assert np.array_equal(after("chroma", grey, factor=3.0), grey)
    assert np.array_equal(after("rotate-hue", grey, angle_deg=77.0), grey)


@given(factors)
@settings(deadline=None)
def test_travel_raises_the_flop_index_by_its_power(factor: float) -> None:
    made = applied("travel", factor=factor)

    present = flop_index(RED)
    assert present is not None
    assert made.share == 1.0
    expected = pytest.approx(present * factor**1.11, rel=1e-12)
    assert flop_index(made.state.lab) == expected


def test_travel_beyond_black_is_limited_in_closed_form() -> None:
    grey = NEUTRAL

    made = applied("travel", grey, factor=10.0)

    # L110 reaches 0 at the factor L45/(L45 - L110); the way starts at 1.
    assert made.share == pytest.approx((50.0 / 20.0 - 1.0) / 9.0)
    assert made.state.lab[2, 0] == pytest.approx(0.0, abs=1e-12)


def test_no_travel_makes_a_solid() -> None:
    lab = after("travel", factor=0.0, channels="Lab")

    assert np.array_equal(lab, [RED[1]] * 3)


def test_travel_of_a_and_b_leaves_the_lightness() -> None:
    lab = after("travel", factor=0.5, channels="ab")

    assert np.array_equal(lab[:, 0], np.array(RED)[:, 0])
    assert lab[0, 1:].tolist() == [53.0, 35.0]


@given(st.floats(0.5, 9.0))
@settings(deadline=None)
def test_flop_index_is_set_to_a_value(index: float) -> None:
    lab = after("set-flop-index", flop_index=index)

    assert flop_index(lab) == pytest.approx(index, rel=1e-12)


def test_mirror_twice_changes_no_bit() -> None:
    soft = np.array(RED_AT_FIVE) * (1.0, 0.3, 0.3)

    once = after("mirror", soft, channels="ab")

    assert np.array_equal(once[:, 0], soft[:, 0])
    assert np.array_equal(once[:, 1:], soft[::-1, 1:])
    assert np.array_equal(after("mirror", once), soft)


def test_mirror_out_of_reach_is_made_in_part() -> None:
    made = applied("mirror", RED)

    # b at the flop rises from 20 towards 40, but L = 20 allows 200/116 · 20.
    assert made.share == pytest.approx((200.0 / 116.0 * 20.0 - 20.0) / 20.0)


def test_mirrored_lightness_has_no_flop_index() -> None:
    neutral = after("mirror", NEUTRAL, channels="Lab")

    assert flop_index(neutral) == 0.0


@pytest.mark.parametrize(("step", "row"), [("set-face", 0), ("set-flop", 2)])
def test_end_point_is_set_and_the_other_stays(step: str, row: int) -> None:
    lab = after(step, L=60.0 if row == 0 else 17.0, a=30.0)

    other = 2 - row
    assert lab[row].tolist() == [60.0 if row == 0 else 17.0, 30.0, RED[row][2]]
    assert np.array_equal(lab[other], RED[other])


def test_end_points_keep_the_rate_of_travel() -> None:
    lab = after("set-flop", after("set-face", L=70.0), L=25.0)

    rest = (RED[1][0] - RED[2][0]) / (RED[0][0] - RED[2][0])
    assert (lab[1, 0] - 25.0) / (70.0 - 25.0) == pytest.approx(rest)


def test_solid_can_be_given_a_face() -> None:
    solid = [RED[1]] * 3

    lab = after("set-face", solid, L=60.0)

    assert lab[:, 0] == pytest.approx([60.0, 34.0 + 26.0 * 0.28994, 34.0], abs=1e-3)


def test_sample_is_set_alone() -> None:
    lab = after("set-sample", RED_AT_FIVE, angle_deg=25.0, b=31.0)

    expected = np.array(RED_AT_FIVE)
    expected[1, 2] = 31.0
    assert np.array_equal(lab, expected)


def test_towards_mixes_angle_by_angle() -> None:
    lab = after("towards", paint=make_spec(NEUTRAL), amount=0.25)

    np.testing.assert_allclose(lab, 0.75 * np.array(RED) + 0.25 * np.array(NEUTRAL))


def test_towards_takes_missing_angles_from_the_curve() -> None:
    made = applied("towards", RED_AT_FIVE, paint=make_spec(RED, "goal"), amount=1.0)

    lightness = made.state.lab[:, 0]
    np.testing.assert_allclose(lightness, [52, 45.1849, 34, 23.336, 20], atol=5e-4)
    assert made.notes == ("goal taken from its fitted curve at 25, 75 degrees",)


def test_towards_uses_measured_angles_only_where_it_can() -> None:
    lab = [*RED_AT_FIVE]
    goal = ColorSpec(
        name="six",
        samples=tuple(
            Sample(angle, Lab(*row))
            for angle, row in zip((-15.0, *FIVE), [lab[0], *lab], strict=True)
        ),
    )

    made = applied("towards", NEUTRAL, paint=goal, amount=1.0)

    assert made.notes == ()
    np.testing.assert_allclose(made.state.lab, RED)
