"""What every format has in common: sides, ranges, agreement."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, assemble
from paintlink.intake.conditions import SPECIFICATION
from paintlink.intake.geometries import read_geometry
from paintlink.intake.source import Source
from tests.intake.fixtures import paint

SOURCE = Source("a.txt", b"x")
BANDS = tuple(paint.WAVELENGTHS.tolist())


def row(code: str, level: float, bands: int = 31) -> Row:
    return Row(f"row {code}", read_geometry(code), factors=[level] * bands)


def test_double_path_wins_over_the_two_sides() -> None:
    rows = [row("45as15 LEFT", 0.2), row("45as15 RIGHT", 0.4), row("45as15 DP", 0.3)]

    values = assemble(SOURCE, rows, Scales(wavelengths_nm=BANDS))

    assert [one.code for one in values.geometries] == ["45as15 DP"]


def test_two_sides_without_double_path_give_their_mean() -> None:
    rows = [row("45as15 LEFT", 0.2), row("45as15 RIGHT", 0.4), row("45as45", 0.1)]

    values = assemble(SOURCE, rows, Scales(wavelengths_nm=BANDS))

    assert values.spectra is not None
    codes = [one.code for one in values.geometries]
    assert codes == ["45as45", "45as15 LEFT+45as15 RIGHT"]
    assert values.spectra.factors[1] == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("start", "step", "count", "kept"),
    [(380, 10, 41, 31), (360, 5, 85, 31), (400, 20, 16, 16), (400, 10, 31, 31)],
)
def test_ranges_that_hold_the_visible_one_are_cut(
    start: float, step: float, count: int, kept: int
) -> None:
    bands = tuple(start + step * band for band in range(count))
    one = Row("row 1", read_geometry("15"), factors=[band / 1000 for band in bands])

    values = assemble(SOURCE, [one], Scales(wavelengths_nm=bands))

    assert values.spectra is not None
    assert values.spectra.wavelengths_nm.size == kept
    assert np.allclose(values.spectra.factors[0], values.spectra.wavelengths_nm / 1000)
    assert bool(values.notes) == (count != kept)


@pytest.mark.parametrize(("start", "step"), [(405, 10), (420, 10), (400, 15)])
def test_other_ranges_are_refused(start: float, step: float) -> None:
    bands = tuple(start + step * band for band in range(31))

    with pytest.raises(InputError, match="needed are 400 to 700 nm in steps of 10 or"):
        assemble(SOURCE, [row("15", 0.5)], Scales(wavelengths_nm=bands))


def test_negative_reflectance_is_told_with_its_geometry() -> None:
    with pytest.raises(InputError, match=r"row 15: reflectance of -30 % at 15: calib"):
        assemble(SOURCE, [row("15", -0.3)], Scales(wavelengths_nm=BANDS))


def test_small_disagreement_of_lab_and_spectrum_is_a_note() -> None:
    factors = paint.factors(("45as45",))
    lab = paint.lab(factors)[0] + np.array([1.0, 0.0, 0.0])
    one = Row("row 1", read_geometry("45"), lab.tolist(), factors[0].tolist())

    values = assemble(
        SOURCE, [one], Scales(wavelengths_nm=BANDS, conditions=SPECIFICATION)
    )

    assert values.notes == (
        "spectrum and Lab of 45 differ by 1.00 (CIE76): the spectrum is used",
    )
