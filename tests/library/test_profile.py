from __future__ import annotations

from pathlib import Path

import pytest

from paintlink.errors import ConfigError, LibraryError
from paintlink.library.headings import layout
from paintlink.library.profile import Profile, read_profile


def test_profile_is_read_from_toml(tmp_path: Path) -> None:
    path = tmp_path / "p.toml"
    path.write_text(
        'delimiter = ";"\ndecimal = ","\nencoding = "cp1252"\nobserver = "2"\n'
        '[columns]\ncode = "Nr"\nb-15 = "b*(-15)"\n[finishes]\nUni = "solid"\n'
    )

    assert read_profile(path) == Profile(
        columns={"code": "Nr", "b-15": "b*(-15)"},
        finishes={"Uni": "solid"},
        delimiter=";",
        decimal=",",
        encoding="cp1252",
        observer="2",
    )


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (
            "colums = 1",
            r"a key must be one of columns, finishes, .* \(found 'colums'\)",
        ),
        ("columns = 'x'", "columns must be a table of texts"),
        ("columns.code = 3", "columns must be a table of texts"),
        ("delimiter = 3", "delimiter must be a text"),
        ("columns.L = 'x'", "there is no field 'L': take code, name"),
        ("columns.L200 = 'x'", "there is no field 'L200'"),
        ("finishes.x = 'matt'", "the finish of 'x' must be one of solid, metallic"),
        ("delimiter = 'ab'", "the delimiter is one character"),
        ("decimal = ';'", r"decimal must be one of \., ,"),
        ("observer = '7'", "observer must be one of 10, 2"),
        ("encoding = 'klingon'", "there is no encoding 'klingon'"),
        ("x", "is no TOML file"),
    ],
)
def test_what_no_profile_says_is_refused(tmp_path: Path, text: str, why: str) -> None:
    path = tmp_path / "p.toml"
    path.write_text(text)

    with pytest.raises(ConfigError, match=why) as caught:
        read_profile(path)
    assert str(caught.value).startswith(f"profile {path}")


def test_missing_profile_is_named(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"p\.toml cannot be read: No such file"):
        read_profile(tmp_path / "p.toml")


@pytest.mark.parametrize(
    "spelling",
    ["{L}{a}", "{L}*{a}", "{L} {a}", "{L}_{a}", "{L}*({a}°)", "{a}{L}", "{a}° {L}*",
     "45as{a} {L}", "{L} 45as{a}"],
)  # fmt: skip
def test_usual_headings_are_recognised(spelling: str) -> None:
    headings = ["Color Code", "NAME", "Brand"]
    for angle in ("15", "45", "110"):
        headings += [spelling.format(L=letter, a=angle) for letter in "Lab"]

    found = layout(headings, Profile())

    assert found.angles_deg == (15.0, 45.0, 110.0)
    assert found.lab == ((3, 4, 5), (6, 7, 8), (9, 10, 11))
    assert found.texts == {"code": 0, "name": 1}
    assert found.extras == {"Brand": 2}


@pytest.mark.parametrize("spelling", ["{L}-15", "-15 {L}", "{L}*(-15°)", "{L}m15"])
def test_angle_beyond_the_mirror_is_recognised(spelling: str) -> None:
    headings = ["code"]
    for letter in "Lab":
        headings += [spelling.format(L=letter), f"{letter}15", f"{letter}45"]

    assert layout(headings, Profile()).angles_deg == (-15.0, 15.0, 45.0)


def test_profile_goes_before_what_is_recognised() -> None:
    lab = [f"{letter}{angle}" for angle in (15, 45, 110) for letter in "Lab"]
    profile = Profile(columns={"code": "Number", "L15": "bright"})

    found = layout(["code", "Number", "bright", *lab], profile)

    assert found.texts == {"code": 1}
    assert found.lab[0] == (2, 4, 5)
    assert set(found.extras) == {"code", "L15"}


@pytest.mark.parametrize(
    ("columns", "why"),
    [
        ({"code": "Nummer"}, "no column is called 'Nummer', named for code; there are"),
        ({"L20": "no"}, "no column holds a at 20 degrees: name it, as in --map"),
    ],
)
def test_mapping_that_does_not_fit_is_refused(
    columns: dict[str, str], why: str
) -> None:
    lab = [f"{letter}{angle}" for angle in (15, 45, 110) for letter in "Lab"]

    with pytest.raises(LibraryError, match=why):
        layout(["code", "no", *lab], Profile(columns=columns))
