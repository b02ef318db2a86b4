"""The forecast against labels of the formulation stand-in that it never saw."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from paintlink.errors import LibraryError
from paintlink.library import bundled, find, paint_spec
from paintlink.model import FloatArray
from paintlink.snap import forecast
from paintlink.snap.makeable import chances, data
from paintlink.snap.makeable.features import place, unplace
from tests.snap.conftest import STANDARD, make_target

MAKEABLE_DE00 = 1.0
Made = NDArray[np.bool_]


@pytest.fixture(scope="module")
def unseen() -> tuple[FloatArray, Made, Made]:
    """Chance, whether makeable, whether a design, of the labels not learned from."""
    with np.load(data.FOLDER / data.LABELS) as labels:
        lab = labels["lab_hundredths"].astype(float) / 100.0
        made = labels["residual_thousandths"] <= 1000.0 * MAKEABLE_DE00
        design = labels["design"]
    later = (np.arange(len(lab)) // 2) % 2 == 1
    return chances(lab[later]), made[later], design[later]


def area(chance: FloatArray, made: Made) -> float:
    """How often a makeable colour gets the higher chance, pair by pair."""
    able, unable = chance[made], np.sort(chance[~made])
    below = np.searchsorted(unable, able, side="left")
    equal = np.searchsorted(unable, able, side="right") - below
    return float((below + 0.5 * equal).mean() / len(unable))


def miscalibration(chance: FloatArray, made: Made) -> float:
    edges = np.linspace(0.0, 1.0, 11)[1:-1]
    place_of = np.digitize(chance, edges)
    shares = [np.mean(place_of == one) for one in range(10)]
    apart = [
        abs(chance[place_of == one].mean() - made[place_of == one].mean())
        if share
        else 0.0
        for one, share in enumerate(shares)
    ]
    return float(np.dot(shares, apart))


def test_two_thousand_colours_were_never_seen_half_of_them_designs(
    unseen: tuple[FloatArray, Made, Made],
) -> None:
    chance, _, design = unseen

    assert len(chance) >= 2000
    assert design.sum() * 2 == len(chance)


def test_makeable_colours_get_the_higher_chance(
    unseen: tuple[FloatArray, Made, Made],
) -> None:
    chance, made, design = unseen

    assert area(chance, made) >= 0.97
    assert area(chance[design], made[design]) >= 0.95


def test_chance_is_how_often_it_comes_true(
    unseen: tuple[FloatArray, Made, Made],
) -> None:
    chance, made, _ = unseen

    assert miscalibration(chance, made) <= 0.03


def test_known_paint_can_be_made_and_an_absurd_design_cannot() -> None:
    paint = make_target([[89.5, 39.6, 16.2], [36.1, 19.7, 7.8], [11.4, 12.2, 4.1]])
    absurd = make_target([[90.0, 90.0, -90.0], [30.0, -90.0, 60.0], [80.0, 0.0, 0.0]])

    good, bad = forecast(paint), forecast(absurd)

    assert good.chance > 0.9
    assert good.sentence.startswith(
        "forecast: the virtual paint system can make this colour (chance "
    )
    assert bad.chance < 0.05
    assert "can hardly make this colour" in bad.sentence
    assert f"nearest it can make is {bad.away:.1f} away per angle" in bad.sentence


def test_suggestion_is_makeable_and_not_far() -> None:
    table = bundled()
    paint = paint_spec(table, find(table, "RM209")).lab(*STANDARD)
    design = forecast(make_target(paint * (1.0, 1.4, 1.4)))

    again = forecast(make_target(design.suggestion))

    assert not design.likely
    assert again.likely
    assert again.away < 0.05
    assert 0.0 < design.away < 30.0


def test_places_can_be_undone() -> None:
    rng = np.random.default_rng(1)
    lab = rng.uniform((0, -120, -120), (160, 120, 120), (200, 3, 3))
    lab[0, 0] = (50.0, 0.0, 0.0)

    np.testing.assert_allclose(unplace(place(lab)), lab, atol=1e-9)


@pytest.mark.parametrize(
    ("angles", "observer"), [((25.0, 45.0, 75.0), "10"), (STANDARD, "2")]
)
def test_refuses_what_it_did_not_learn(
    angles: tuple[float, ...], observer: str
) -> None:
    target = make_target([[50.0, 0.0, 0.0]] * 3, angles_deg=angles, observer=observer)

    with pytest.raises(LibraryError, match="a forecast needs Lab at 15, 45 and 110"):
        forecast(target)


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    data.knowledge.cache_clear()
    monkeypatch.setattr(data, "FOLDER", tmp_path)
    yield
    data.knowledge.cache_clear()


@pytest.mark.usefixtures("empty")
def test_missing_data_is_named() -> None:
    with pytest.raises(LibraryError, match=r"data of the forecast .*: reinstall"):
        forecast(make_target([[50.0, 0.0, 0.0]] * 3))
