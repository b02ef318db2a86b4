"""Printed MA68 reports."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.ma68_print import document, report


def imported(text: str | bytes) -> Import:
    data = text if isinstance(text, bytes) else text.encode()
    return read_any(data, name="ma68.txt")


def refusal(text: str | bytes) -> str:
    with pytest.raises(InputError, match=r"ma68\.txt") as caught:
        imported(text)
    return str(caught.value)


def test_reports_of_a_file_become_readings() -> None:
    found = imported(document())

    assert found.format_id == "ma68_print"
    first, second = found.items
    assert (first.name, second.name) == ("X-RITE MA68II Basalt 7", "Basalt 8")
    assert first.reading is not None
    assert first.reading.instrument.model == "MA68II"
    assert first.reading.measurement.spectra is not None
    wanted = paint.factors(paint.FIVE)
    assert np.allclose(first.reading.measurement.spectra.factors, wanted, atol=0.5e-4)
    assert first.spec is not None
    assert first.spec.angles_deg == (15, 25, 45, 75, 110)
    assert "no time of measurement in the file: the file's own time was taken" in (
        found.notes
    )


def test_rows_of_samples_without_standards_are_read() -> None:
    lines = []
    for line in report().splitlines():
        cells = line.split()
        is_band = len(cells) == 11
        lines.append("  ".join([cells[0], *cells[2::2]]) if is_band else line)

    (item,) = imported("\n".join(lines)).items

    assert item.spec is not None
    assert item.spec.lab(45) == pytest.approx(
        imported(report()).items[0].spec.lab(45)  # type: ignore[union-attr]
    )


def test_decimal_commas_are_read() -> None:
    (item,) = imported(report().replace(".", ",")).items

    assert item.spec is not None


def test_utf16_from_a_windows_editor_is_read() -> None:
    assert len(imported(report().encode("utf-16")).items) == 1
    assert len(imported(report().encode("utf-16-le")).items) == 1


def test_bad_number_is_told_with_line_and_column() -> None:
    lines = report().splitlines()
    cells = lines[5].split()
    cells[4] = "2O.1"
    lines[5] = "  ".join(cells)

    assert refusal("\n".join(lines)) == (
        "ma68.txt, line 6, column 5: not a number: correct it or export again "
        "(found '2O.1')"
    )


def test_mixed_decimal_signs_are_told() -> None:
    lines = report().splitlines()
    lines[5] = lines[5].replace(".", ",")

    assert "line 6, column 3: a decimal comma where the file has the other sign" in (
        refusal("\n".join(lines))
    )


def test_missing_row_is_told_with_its_wavelength() -> None:
    lines = report().splitlines()
    del lines[10]

    assert (
        "line 11: expected the row of 490 nm: print the report again (found '500')"
        in (refusal("\n".join(lines)))
    )


def test_cut_report_is_told() -> None:
    lines = report().splitlines()

    assert "line 21: 20 rows of wavelengths, expected 31 from 400 to 700" in refusal(
        "\n".join(lines[:21])
    )


def test_other_column_count_is_told() -> None:
    lines = [line.rsplit(maxsplit=1)[0] for line in report().splitlines()]

    assert "line 2: 10 numbers in the row: expected a wavelength and five pairs" in (
        refusal("\n".join(lines))
    )


def test_fractions_in_place_of_percent_are_noted() -> None:
    lines = []
    for line in report().splitlines():
        cells = line.split()
        if len(cells) == 11:
            cells[1:] = [f"{float(cell) / 100:.4f}" for cell in cells[1:]]
        lines.append("  ".join(cells))

    assert any(
        "import with --scale fraction" in n for n in imported("\n".join(lines)).notes
    )
