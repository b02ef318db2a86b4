"""Datacolor QTX files."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, Options, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.datacolor_qtx import document, section


def imported(text: str | bytes, **options: object) -> Import:
    data = text if isinstance(text, bytes) else text.encode()
    return read_any(data, name="a.qtx", options=Options(**options))  # type: ignore[arg-type]


def refusal(text: str | bytes) -> str:
    with pytest.raises(InputError, match=r"a\.qtx") as caught:
        imported(text)
    return str(caught.value)


def test_standards_and_batches_become_solid_readings() -> None:
    found = imported(document(), finish="solid")

    assert found.format_id == "datacolor_qtx"
    assert [item.name for item in found.items] == ["Basalt 7", "Basalt 8"]
    reading = found.items[0].reading
    assert reading is not None
    assert reading.taken_at == datetime(2026, 3, 14, 8, 26, 53, tzinfo=UTC)
    assert reading.measurement.spectra is not None
    wanted = paint.factors(("45as45",))
    assert np.allclose(reading.measurement.spectra.factors, wanted, atol=1e-9)
    assert found.items[0].spec is not None
    assert any("right for solid colours only" in note for note in found.notes)


def test_effect_colours_are_refused_for_a_single_angle() -> None:
    assert all(
        "multi-angle instrument (solid: --finish solid, or finish in [inbox])"
        in item.refused
        for item in imported(document()).items
    )


def test_specular_included_is_refused_unless_declared() -> None:
    text = section("STANDARD", 0, "a", viewing="SCI")

    assert "line 1: measured with the gloss included, which no 45 degree" in refusal(
        text
    )
    assert imported(text, geometry="45as45", finish="solid").items[0].spec is not None


def test_sections_of_one_name_at_several_angles_are_one_reading() -> None:
    text = "".join(
        section("STANDARD", number, "a", viewing=code)
        for number, code in enumerate(paint.FIVE)
    )

    (item,) = imported(text).items

    assert item.spec is not None
    assert item.spec.angles_deg == (15, 25, 45, 75, 110)


def test_longer_range_is_cut_and_told() -> None:
    values = [20.0] * 4 + (100.0 * paint.factors(("45as45",))[0]).tolist()
    text = (
        "[STANDARD_DATA 0]\nSTD_NAME=a\nSTD_REFLPOINTS=35\nSTD_REFLINTERVAL=10\n"
        "STD_REFLLOW=360\nSTD_R=" + ",".join(map(str, values))
    )

    found = imported(text, finish="solid")

    assert found.items[0].spec is not None
    assert "a: spectra from 360 to 700 nm: 400 to 700 nm in steps of 10 are used" in (
        found.notes
    )
    assert any("no geometry in the file" in note for note in found.notes)


def test_range_that_misses_a_part_is_refused() -> None:
    text = section("STANDARD", 0, "a").replace("REFLLOW=400", "REFLLOW=420")

    assert "31 wavelengths from 420 to 720 nm; needed are 400 to 700" in refusal(text)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("REFLPOINTS=31", "REFLPOINTS=35", "31 reflectance values where 35 are"),
        ("REFLPOINTS=31", "REFLPOINTS=x", "line 4: STD_REFLPOINTS is no whole number"),
        ("DATETIME=1773476813", "DATETIME=soon", "line 3: not a time of the form"),
        ("_R=", "_R=1,two,", "line 8, value 2: not a number: correct it"),
        ("_R=", "_R=1,,", "line 8, value 2: a number is missing"),
    ],
)
def test_damaged_entries_are_told_with_their_line(
    old: str, new: str, told: str
) -> None:
    assert told in refusal(section("STANDARD", 0, "a").replace(old, new))


def test_latin_names_are_read_with_a_note() -> None:
    text = section("STANDARD", 0, "Blau Größe").encode("latin-1")

    found = imported(text)

    assert found.items[0].name == "Blau Größe"
    assert "not UTF-8: read as Windows-1252" in found.notes


def test_same_name_twice_stays_two_readings() -> None:
    text = section("BATCH", 0, "a") + section("BATCH", 1, "a", 1)

    assert len(imported(text).items) == 2


def test_millions_of_lines_are_refused_at_once() -> None:
    assert "more than 1000000 lines: split the export" in refusal(
        "[STANDARD_DATA 0]\n" + "1\n" * 1_100_000
    )
