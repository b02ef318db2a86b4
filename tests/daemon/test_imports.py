"""Colours from files on their way into the journal."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.daemon.averaging import average
from paintlink.daemon.imports import averaged, summary
from paintlink.errors import ReadingError
from paintlink.intake import Import, Item, read_any
from tests.daemon.conftest import make_reading
from tests.intake.fixtures.mat12_xlsx import book, document, saved


def twice(**changes: object) -> Import:
    """Two readings under one name, the second changed."""
    reading = make_reading()
    other = replace(
        make_reading(raw=b"other"),
        measurement=replace(reading.measurement, raw=b"other", **changes),
    )
    items = (Item("bonnet", reading), Item("bonnet", other))
    return Import("a.json", "00", "xrite_job_json", "X-Rite job data", items)


def test_readings_of_one_name_become_their_mean() -> None:
    found = twice()

    (item,) = averaged(found).items

    assert item.spec is not None
    assert item.reading is not None
    assert item.reading.measurement.averaged == 6
    assert item.reading.measurement.raw == b"\x00rawother"


def test_readings_of_other_names_stay_as_they_are() -> None:
    found = read_any(document(), name="qc.xlsx")

    assert averaged(found) == found


def test_data_modes_never_mix() -> None:
    (item,) = averaged(twice(data_mode="byk")).items

    assert item.spec is None
    assert item.refused == (
        "readings of one sample were taken in the data modes byk, native, which give "
        "different numbers for one panel: take it again in one mode"
    )


def test_spectra_on_other_wavelengths_are_not_averaged() -> None:
    first = make_reading().measurement
    assert first.spectra is not None
    shifted = replace(
        first.spectra, wavelengths_nm=np.asarray(first.spectra.wavelengths_nm) + 5.0
    )

    with pytest.raises(ReadingError, match="Lab or spectra of different kinds"):
        average([first, replace(first, spectra=shifted)])


def test_simulated_and_real_readings_are_not_averaged() -> None:
    found = twice()
    real, other = found.items
    assert other.reading is not None
    simulated = replace(other, reading=replace(other.reading, origin="simulated"))

    (item,) = averaged(replace(found, items=(real, simulated))).items

    assert "simulated and real readings have one name" in item.refused


def test_summary_names_what_was_left_out() -> None:
    made = book(("whole", "cut"))
    made["Color Data"].delete_rows(27, 2)
    made["Spectral Data"].delete_rows(26, 2)

    text = summary(read_any(saved(made), name="qc.xlsx"))

    assert text.startswith("1 of 2 colours left out: cut: the reading has 10")
