from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.model import AngleDifference
from paintlink.snap import nearest, words
from tests.snap.conftest import STANDARD, make_table, make_target

NEUTRAL = [[60.0, 1.0, 0.0]] * 3


def said(
    target: list[list[float]],
    paint: list[list[float]],
    angles_deg: tuple[float, ...] = STANDARD,
) -> str:
    table = make_table([paint], angles_deg=angles_deg)
    spec = make_target(target, angles_deg=angles_deg)
    return nearest(spec, table, angles_deg=angles_deg)[0].words


def moved(
    paint: list[list[float]], *steps: tuple[float, float, float]
) -> list[list[float]]:
    return (np.array(paint) + np.array(steps)).tolist()


def turned(chroma: float, hue_deg: float) -> list[list[float]]:
    hue = np.radians(hue_deg)
    return [[50.0, float(chroma * np.cos(hue)), float(chroma * np.sin(hue))]] * 3


def test_lighter_means_that_the_target_is_lighter() -> None:
    target = moved(NEUTRAL, (1.2, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -0.8))

    assert said(target, NEUTRAL) == "target: face 1.2 lighter, flop 0.8 bluer"
    assert said(NEUTRAL, target) == "target: face 1.2 darker, flop 0.8 yellower"


def test_only_the_largest_difference_of_an_angle_is_said() -> None:
    target = moved(NEUTRAL, (1.2, 0.0, 0.0), (0.6, -2.0, 1.9), (0.0, 0.0, 0.0))

    assert said(target, NEUTRAL) == "target: face 1.2 lighter, mid 2.0 greener"


def test_what_nobody_sees_is_not_said() -> None:
    target = moved(NEUTRAL, (0.4, 0.4, -0.4), (0.0, 0.0, 0.0), (-0.49, 0.0, 0.0))

    assert said(target, NEUTRAL) == "target: no visible difference"


def test_same_difference_everywhere_is_said_once() -> None:
    target = moved(NEUTRAL, *[(-3.0, 0.0, 0.0)] * 3)

    assert said(target, NEUTRAL) == "target: 3.0 darker throughout"


def test_difference_between_the_named_angles_is_not_denied() -> None:
    angles = (15.0, 25.0, 45.0, 75.0, 110.0)
    target = [[60.0 + step, 1.0, 0.0] for step in (0.0, 2.0, 0.0, -0.7, 0.0)]

    assert said(target, [[60.0, 1.0, 0.0]] * 5, angles) == (
        "target: at 25 2.0 lighter, at 75 0.7 darker"
    )


@pytest.mark.parametrize(
    ("angle_deg", "place"),
    [(25.0, "face"), (45.0, "mid"), (75.0, "flop"), (-15.0, "at -15")],
)
def test_single_angle_keeps_its_name(angle_deg: float, place: str) -> None:
    differences = [AngleDifference(angle_deg, 3.0, -3.0, 0.0, 0.0, 0.0, 0.0)]

    text = words(differences, np.array([[60.0, 1.0, 0.0]]))

    assert text == f"target: {place} 3.0 darker"


@pytest.mark.parametrize(
    ("step", "word"),
    [((0, 2, 0), "redder"), ((0, -2, 0), "greener"), ((0, 0, 2), "yellower")],
)
def test_neutrals_lean_to_a_colour(step: tuple[float, float, float], word: str) -> None:
    assert said(moved(NEUTRAL, *[step] * 3), NEUTRAL).endswith(f"2.0 {word} throughout")


@pytest.mark.parametrize(("chroma", "word"), [(44.0, "more"), (36.0, "less")])
def test_chroma_of_chromatic_colours_is_named(chroma: float, word: str) -> None:
    assert said(turned(chroma, 30), turned(40, 30)) == (
        f"target: 4.0 {word} chromatic throughout"
    )


@pytest.mark.parametrize(
    ("hue_deg", "counter_clockwise", "clockwise"),
    [
        (30, "yellower", "bluer"),  # red
        (55, "yellower", "redder"),  # orange
        (88, "greener", "redder"),  # yellow
        (125, "greener", "yellower"),  # lime
        (160, "bluer", "yellower"),  # green
        (210, "bluer", "greener"),  # turquoise
        (262, "redder", "greener"),  # blue
        (310, "redder", "bluer"),  # violet
    ],
)
def test_hue_turns_towards_its_neighbours(
    hue_deg: float, counter_clockwise: str, clockwise: str
) -> None:
    paint = turned(40, hue_deg)

    assert f" {counter_clockwise} " in said(turned(40, hue_deg + 5), paint)
    assert f" {clockwise} " in said(turned(40, hue_deg - 5), paint)


def test_other_angles_than_face_mid_flop_stay_unnamed() -> None:
    angles = (-15.0, 15.0, 25.0, 45.0, 75.0)
    target = [[60.0 + step, 1.0, 0.0] for step in (9.0, 1.0, 8.0, 2.0, 3.0)]

    assert said(target, [[60.0, 1.0, 0.0]] * 5, angles) == (
        "target: face 1.0 lighter, mid 2.0 lighter, flop 3.0 lighter"
    )


@given(
    st.lists(
        st.tuples(st.floats(-30, 30), st.floats(-30, 30), st.floats(-30, 30)),
        min_size=3,
        max_size=3,
    ),
    st.floats(0, 60),
    st.floats(0, 360),
)
def test_words_are_short_and_never_claim_a_match(
    steps: list[tuple[float, float, float]], chroma: float, hue_deg: float
) -> None:
    text = said(moved(turned(chroma, hue_deg), *steps), turned(chroma, hue_deg))

    assert text.startswith("target: ")
    assert "match" not in text
    assert len(text) <= 90
