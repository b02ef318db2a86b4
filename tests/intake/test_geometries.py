"""Every spelling of a geometry means the same and is kept."""

from __future__ import annotations

import pytest

from paintlink.errors import InputError
from paintlink.intake.conditions import read_conditions, split_conditions
from paintlink.intake.geometries import read_geometry, side_of

SPELLINGS = {
    (45.0, -15.0, 0.0): (
        "45as-15", "45asMinus15", "r45as-15", "45AS-15", "45as\u221215", "-15",
        "45° as -15°", "-15 deg", "45as-15az0", "45 as minus 15", "DP 45as-15",
    ),
    (45.0, 110.0, 0.0): ("45as110", "110", "110°", "r45as110", "110.0", "45as+110"),
    (45.0, 45.0, 0.0): ("45_0", "45/0", "45:0", "0:45", "0/45", "45as45", "45:0c"),
    (15.0, -45.0, 0.0): ("15as-45", "15asMinus45", "r15as-45"),
    (45.0, 25.0, 90.0): ("45as25az90", "r45as25az90"),
    (45.0, 25.0, -90.0): ("45as25az-90", "45as25azMinus90"),
    (45.0, 60.0, 125.3): ("45as60az125.3",),
    (15.0, 46.9, 104.5): ("15as46.9az104.5",),
    (15.0, 38.3, 43.0): ("15as38.3az43",),
}  # fmt: skip


@pytest.mark.parametrize(
    ("code", "angles"),
    [(code, angles) for angles, codes in SPELLINGS.items() for code in codes],
)
def test_spelling_gives_its_angles_and_stays(
    code: str, angles: tuple[float, float, float]
) -> None:
    found = read_geometry(code)

    assert (found.illumination_deg, found.aspecular_deg, found.azimuth_deg) == angles
    assert found.code == code


@pytest.mark.parametrize("code", ["sphere", "SCI", "SCE", "d/8", "d:8", "15d", "SPIN"])
def test_diffuse_geometries_are_refused_with_the_way_out(code: str) -> None:
    with pytest.raises(InputError, match=r"is diffuse, .* --geometry 45as45"):
        read_geometry(code)


@pytest.mark.parametrize(
    "code", ["", "x", "45as", "45as999", "95as15", "as15", "1" * 99]
)
def test_other_texts_are_no_geometry(code: str) -> None:
    with pytest.raises(InputError, match="geometry '"):
        read_geometry(code)


def test_sides_of_a_double_measurement_are_told() -> None:
    sides = [side_of(code) for code in ("45as15 LEFT", "Right_45as15", "45as15 (DP)")]

    assert sides == ["left", "right", "dp"]
    assert side_of("45as15") == ""


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("D65/10", "D65/10"),
        ("D65/10°", "D65/10"),
        ("d65-2", "D65/2"),
        ("A 10 Deg", None),
        ("F11/10", "F11/10"),
        ("TL84/10", "F11/10"),
        ("D50 / 2", "D50/2"),
    ],
)
def test_conditions_are_read_in_their_spellings(text: str, wanted: str | None) -> None:
    if wanted is None:
        with pytest.raises(InputError, match="does not name illuminant and observer"):
            split_conditions(text)
    else:
        assert str(split_conditions(text)) == wanted


@pytest.mark.parametrize("observer", ["10", "10_Degree", "10°", "1964", "10 deg"])
def test_observers_are_read_in_their_spellings(observer: str) -> None:
    assert read_conditions("D65", observer).observer == "10"
