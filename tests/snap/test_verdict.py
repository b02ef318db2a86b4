from __future__ import annotations

from dataclasses import replace

import pytest

from paintlink.model import Match
from paintlink.snap import BAND_LABELS, Band, band, nearest, starting_paint
from tests.snap.conftest import make_table, make_target


@pytest.fixture
def match() -> Match:
    target = make_target([[51.0, 0.0, 0.0]] * 3)
    return nearest(target, make_table([[[50.0, 0.0, 0.0]] * 3]))[0]


@pytest.mark.parametrize(
    ("mean", "expected"),
    [(0.0, "green"), (1.5, "green"), (1.51, "amber"), (3.0, "amber"), (3.01, "red")],
)
def test_band_follows_the_mean_per_angle(
    match: Match, mean: float, expected: Band
) -> None:
    assert band(replace(match, total=mean * 3)) == expected


def test_limits_of_the_bands_can_be_set(match: Match) -> None:
    assert band(match, green_up_to=0.5, amber_up_to=1.0) == "amber"
    assert band(match, green_up_to=0.2, amber_up_to=0.5) == "red"


def test_every_band_is_called_a_starting_point() -> None:
    assert set(BAND_LABELS) == {"green", "amber", "red"}
    assert all("starting point" in label for label in BAND_LABELS.values())
    assert not any("match" in label for label in BAND_LABELS.values())


def test_starting_paint_keeps_code_numbers_and_conditions(match: Match) -> None:
    paint = starting_paint(match)

    assert (paint.code, paint.library, paint.generation) == ("C0", "Test book", "gen-1")
    assert (paint.formula, paint.total) == ("cie76", 3.0)
    assert paint.differences == match.differences
    assert paint.differences[0].dL == 1.0
