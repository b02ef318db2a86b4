"""The MA-T12 workbook: a real one, synthetic ones, broken ones."""

from __future__ import annotations

import io
import zipfile
from datetime import UTC, datetime
from pathlib import Path
from zoneinfo import ZoneInfo

import numpy as np
import pytest
from openpyxl import Workbook

from paintlink.errors import InputError
from paintlink.intake import Import, Options, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.mat12_xlsx import book, document, saved

REAL = Path(__file__).parents[2] / "../shared/data/xrite_mat12_qc_export_noimages.xlsx"
BERLIN = ZoneInfo("Europe/Berlin")


def imported(made: Workbook, **options: object) -> Import:
    return read_any(saved(made), name="qc.xlsx", options=Options(**options))  # type: ignore[arg-type]


def refusal(made: Workbook) -> str:
    with pytest.raises(InputError, match=r"qc\.xlsx") as caught:
        imported(made)
    return str(caught.value)


def test_real_workbook_gives_twelve_geometries_with_its_own_lab() -> None:
    if not REAL.exists():
        pytest.skip("needs ../shared/data, which is not part of the project")
    from openpyxl import load_workbook

    sheet = load_workbook(REAL)["Color Data"]
    rows = [row for row in sheet.iter_rows(min_row=5, values_only=True) if row[2]]

    (item,) = read_any(REAL).items

    assert item.reading is not None
    assert item.spec is not None
    values = item.reading.measurement
    assert [one.code for one in values.geometries] == [row[2] for row in rows]
    assert len(values.geometries) == 12
    assert values.lab is not None
    assert np.array_equal(values.lab.lab, [row[3:6] for row in rows])
    told = {row[2]: row[3:6] for row in rows}
    for sample in item.spec.samples:
        assert sample.lab == pytest.approx(
            told[f"45as{sample.aspecular_deg:g}"], abs=5e-4
        )


def test_each_name_becomes_a_reading() -> None:
    found = read_any(document(), name="qc.xlsx", options=Options(zone=BERLIN))

    assert found.format_id == "mat12_xlsx"
    assert [item.name for item in found.items] == ["Basalt 7", "Basalt 8"]
    reading = found.items[0].reading
    assert reading is not None
    assert reading.taken_at == datetime(2026, 3, 14, 8, 26, 53, tzinfo=UTC)
    assert reading.instrument.model == "MA-T12"
    assert reading.measurement.spectra is not None
    spectra = paint.factors(paint.MA_T12, 0)
    assert np.array_equal(reading.measurement.spectra.factors, spectra)
    assert reading.measurement.texture[0].name == "Graininess 15d"
    spec = found.items[0].spec
    assert spec is not None
    assert spec.angles_deg == (-15, 15, 25, 45, 75, 110)


def test_same_reading_in_another_workbook_has_the_same_bytes() -> None:
    alone = imported(book(("Basalt 7",))).items[0].reading
    beside = imported(book(("Basalt 7", "Basalt 8"))).items[0].reading

    assert alone is not None
    assert beside is not None
    assert alone.measurement.raw == beside.measurement.raw


def test_empty_rows_around_the_readings_are_ignored() -> None:
    made = book()
    made["Color Data"].append([None] * 6)
    made["Spectral Data"].append([""] * 34)

    assert len(imported(made).items) == 1


def test_workbook_without_spectra_gives_its_lab() -> None:
    made = book()
    del made["Spectral Data"]

    (item,) = imported(made).items

    assert item.spec is not None
    assert item.spec.spectra == ()


def test_number_that_is_none_is_told_with_its_cell() -> None:
    made = book()
    made["Spectral Data"]["F7"] = "n/a"

    assert refusal(made) == (
        "qc.xlsx, sheet 'Spectral Data', cell F7: not a number: correct it or "
        "export again (found 'n/a')"
    )


def test_missing_number_is_told_with_its_cell() -> None:
    made = book()
    made["Spectral Data"]["AH4"] = None

    assert "cell AH4: a number is missing: fill it in" in refusal(made)


def test_decimal_comma_in_a_text_cell_is_told() -> None:
    made = book()
    made["Color Data"]["D5"] = "54,85"

    assert "cell D5: a decimal comma where the file has the other" in refusal(made)


def test_doubled_geometry_is_told_with_both_rows() -> None:
    made = book()
    made["Color Data"]["C6"] = "15as-45"

    text = refusal(made)

    assert "sheet 'Color Data', row 6: geometry 15as-45 of 'Basalt 7' stands" in text
    assert "before in row 5: remove one of the two rows" in text


def test_same_geometry_in_two_spellings_is_doubled_too() -> None:
    made = book()
    for sheet, row in (("Color Data", 6), ("Spectral Data", 5)):
        made[sheet][f"C{row}"] = "r15as-45"

    assert "geometry r15as-45 stands twice in one reading, before as" in refusal(made)


def test_reading_that_lacks_angles_is_refused_and_the_others_stay() -> None:
    made = book(("whole", "cut"))
    made["Color Data"].delete_rows(27, 2)
    made["Spectral Data"].delete_rows(26, 2)

    whole, cut = imported(made).items

    assert whole.spec is not None
    assert cut.spec is None
    assert "it holds the aspecular angles -15, 15, 25, 45: a specification" in (
        cut.refused
    )


def test_geometry_in_one_sheet_only_is_told() -> None:
    made = book()
    made["Spectral Data"].delete_rows(4)

    assert "geometry 15as-45 has no spectrum while other geometries" in refusal(made)


def test_percent_in_place_of_fractions_is_told_with_the_option() -> None:
    made = book()
    for row in made["Spectral Data"].iter_rows(min_row=4, min_col=4):
        for cell in row:
            cell.value *= 100.0

    text = refusal(made)

    assert "sheet 'Spectral Data', row 4: reflectance" in text
    assert "fractions (1 = 100 %): import with --scale percent" in text
    (item,) = imported(made, scale="percent").items
    assert item.spec is not None


def test_mixed_scales_name_the_row_that_differs() -> None:
    made = book()
    for cell in made["Spectral Data"][9][3:]:
        cell.value *= 100.0

    text = refusal(made)

    assert "row 9: reflectance" in text
    assert "other geometries of the reading are not: correct it" in text


def test_lab_that_contradicts_the_spectrum_is_refused() -> None:
    made = book()
    made["Color Data"]["D10"] = 5.0

    text = refusal(made)

    assert "spectrum and Lab of 15as80 differ by" in text
    assert "check scale, column order and illuminant" in text


@pytest.mark.parametrize(
    ("conditions", "told"),
    [
        ("F2/10", "illuminant 'F2' is unknown (known: D65, D50, A, F11)"),
        ("D65/4", "observer '4' is unknown (known: 10 and 2 degrees)"),
        ("D65", "'D65' does not name illuminant and observer: write D65/10"),
    ],
)
def test_unknown_conditions_are_told_with_their_cell(
    conditions: str, told: str
) -> None:
    made = book()
    made["Color Data"]["B3"] = conditions

    assert f"sheet 'Color Data', cell B3: {told}" in refusal(made)


def test_other_illuminant_without_spectra_is_refused_for_the_reading() -> None:
    made = book()
    del made["Spectral Data"]
    made["Color Data"]["B3"] = "A/10"

    (item,) = imported(made).items

    assert item.spec is None
    assert "Lab for A/10, the specification needs D65/10" in item.refused


def test_time_that_is_no_time_is_told() -> None:
    made = book()
    made["Color Data"]["B5"] = "yesterday"

    assert "cell B5: not a time: give the column the cell format date" in refusal(made)


def test_workbook_of_something_else_is_told_what_to_do() -> None:
    made = Workbook()
    made.active.append(["invoice", 1])

    text = refusal(made)

    assert "without readings in the sheets 'Color Data' or 'Spectral Data'" in text
    assert "(sheets: Sheet): export QC data, or save a table as CSV" in text


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9, 0.99])
def test_truncated_workbook_is_told(share: float) -> None:
    data = document()

    with pytest.raises(InputError, match=r"cut|no file paintlink can import"):
        read_any(data[: int(share * len(data))], name="qc.xlsx")


def repacked(**members: bytes) -> bytes:
    """The fixture with some members replaced."""
    source = zipfile.ZipFile(io.BytesIO(document()))
    target = io.BytesIO()
    with source, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in [*source.namelist(), "xl/sharedStrings.xml"]:
            key = name.rsplit("/", 1)[-1].removesuffix(".xml")
            if key in members:
                archive.writestr(name, members[key])
            elif key != "sharedStrings":
                archive.writestr(name, source.read(name))
    return target.getvalue()


BOMBS = {
    "a hundred megabytes of blanks": {"sheet1": b"<a>" + b" " * (100 << 20) + b"</a>"},
    "two cells far apart": {
        "sheet1": b'<worksheet><sheetData><row r="1"><c r="A1"><v>1</v></c></row>'
        b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData></worksheet>'
    },
    "one row far below": {
        "sheet2": b'<worksheet><sheetData><row r="99999999999"><c><v>1</v></c></row>'
        b"</sheetData></worksheet>"
    },
    "a million shared strings": {"sharedStrings": b"<sst>" + b"<si/>" * (20 << 20)},
}


@pytest.mark.parametrize("name", BOMBS)
def test_workbook_that_would_fill_the_memory_is_refused(name: str) -> None:
    data = repacked(**BOMBS[name])
    assert len(data) < 1 << 20

    with pytest.raises(InputError, match=r"qc\.xlsx.*(export|split|cut)"):
        read_any(data, name="qc.xlsx")


def test_entities_in_a_workbook_are_not_expanded() -> None:
    laughs = "".join(
        f'<!ENTITY x{n} "{f"&x{n - 1};" * 10}">' for n in range(1, 12)
    )  # fmt: skip
    types = f'<!DOCTYPE sst [<!ENTITY x0 "ha">{laughs}]>'
    strings = f"{types}<sst><si><t>&x11;</t></si></sst>".encode()
    sheet = (
        b'<worksheet><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c></row>'
        b"</sheetData></worksheet>"
    )

    with pytest.raises(InputError, match=r"qc\.xlsx"):
        read_any(repacked(sharedStrings=strings, sheet1=sheet), name="qc.xlsx")


def test_archive_of_thousands_of_files_is_refused() -> None:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w") as archive:
        archive.writestr("xl/workbook.xml", b"")
        for number in range(2001):
            archive.writestr(f"{number}", b"")

    with pytest.raises(InputError, match="more than 2000 files in the workbook"):
        read_any(target.getvalue(), name="qc.xlsx")


def sheet(body: bytes) -> bytes:
    return b"<worksheet><sheetData>" + body + b"</sheetData></worksheet>"


CELL = b"<c><v>1</v></c>"
HIDDEN = {
    "cells and rows without places": sheet(
        b"<row>" + CELL * 30_000 + b"</row>" + (b"<row>" + CELL + b"</row>") * 30_000
    ),
    "a far cell behind a prefix": sheet(
        b'<x:row r="1048576"><x:c r="XFD1048576"><x:v>1</x:v></x:c></x:row>'
        b'<row r="1"><c r="A1"><v>1</v></c></row>'
    ).replace(b"<worksheet>", b'<worksheet xmlns:x="urn:x">'),
    "a far cell in small letters": sheet(
        b'<row r="1"><c r="a1"><v>1</v></c><c r="xfd1048576"><v>1</v></c></row>'
    ),
    "a far cell whose place comes second": sheet(
        b'<row r="1"><c r="A1"><v>1</v></c><c s="1" r="XFD999999"><v>1</v></c></row>'
    ),
    "markup that a parser passes over": sheet(
        b"<!-- <c r=\"A1\"> --><row>" + CELL * 3 + b"</row>"
    ),
    "places padded with noughts": sheet(
        b'<row r="1"><c r="A1"><v>1</v></c><c r="A0001048576"><v>1</v></c>'
        b'<c r="XFD1"><v>1</v></c></row>'
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", HIDDEN)
def test_places_of_cells_cannot_be_hidden(name: str) -> None:
    with pytest.raises(InputError, match=r"qc\.xlsx.*(damaged|without empty cells)"):
        read_any(repacked(sheet1=HIDDEN[name]), name="qc.xlsx")


@pytest.mark.parametrize("text", [b"NaN", b"inf", b"-Infinity", b"1e999"])
def test_values_that_are_no_finite_numbers_are_told_with_their_row(text: bytes) -> None:
    source = zipfile.ZipFile(io.BytesIO(saved(book())))
    sheet2 = source.read("xl/worksheets/sheet2.xml")
    start = sheet2.index(b"<v>", sheet2.index(b'r="D4"')) + 3
    changed = sheet2[:start] + text + sheet2[sheet2.index(b"</v>", start) :]

    with pytest.raises(InputError, match=r"qc\.xlsx(, sheet 'Spectral Data'.* 4)?: a"):
        read_any(repacked(sheet2=changed), name="qc.xlsx")
