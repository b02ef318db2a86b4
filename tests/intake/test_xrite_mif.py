"""X-Rite MIF files."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, Options, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.xrite_mif import document, measurement

HEAD = "[FILE INFO]\nVERSION=1.0\n[STANDARD]\nNAME=Basalt 7\n"


def imported(text: str | bytes, **options: object) -> Import:
    data = text if isinstance(text, bytes) else text.encode()
    return read_any(data, name="a.mif", options=Options(**options))  # type: ignore[arg-type]


def refusal(text: str | bytes) -> str:
    with pytest.raises(InputError, match=r"a\.mif") as caught:
        imported(text)
    return str(caught.value)


def test_measurement_becomes_a_solid_reading() -> None:
    found = imported(document(), finish="solid")

    assert found.format_id == "xrite_mif"
    (item,) = found.items
    assert item.name == "Basalt 7"
    assert item.spec is not None
    reading = item.reading
    assert reading is not None
    assert reading.measurement.averaged == 3
    assert reading.instrument.model == "SP68"
    assert reading.measurement.spectra is not None
    wanted = paint.factors(("45as45",))
    assert np.allclose(reading.measurement.spectra.factors, wanted, atol=1e-5)
    assert "values taken as percent; the file does not say" in found.notes


def test_values_in_one_list_or_by_wavelength_are_the_same() -> None:
    values = (100.0 * paint.factors(("45as45",))[0]).tolist()
    head = HEAD + "[MEASUREMENT]\nANGL=45\n"
    listed = head + "DATA=" + ";".join(f"{value:.3f}" for value in values)
    keyed = head + "\n".join(
        f"R{400 + 10 * band}={value:.3f}" for band, value in enumerate(values)
    )

    specs = [imported(text, finish="solid").items[0].spec for text in (listed, keyed)]

    assert specs[0] is not None
    assert specs[1] is not None
    assert specs[0].samples == specs[1].samples


def test_several_angles_of_a_standard_are_one_reading() -> None:
    text = HEAD + "".join(
        measurement(angle) for angle in ("15", "25", "45", "75", "110")
    )

    (item,) = imported(text).items

    assert item.spec is not None
    assert item.spec.angles_deg == (15, 25, 45, 75, 110)


def test_fractions_are_told_by_their_size() -> None:
    found = imported(HEAD + measurement(scale=1.0), finish="solid")

    assert found.items[0].spec is not None
    assert "values taken as fraction; the file does not say" in found.notes


def test_values_that_may_be_either_need_the_option() -> None:
    text = HEAD + measurement(scale=1.6)

    assert "may be percent or fractions: say --scale percent or --scale" in refusal(
        text
    )
    assert imported(text, scale="percent", finish="solid").items[0].spec is not None


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("ANGL=45", "ANGL=", "line 5: no ANGL in the measurement: add it, or declare"),
        ("ANGL=45", "ANGL=steep", "line 5: geometry 'steep' is not of the form"),
        ("ANGL=45", "ANGL=45\nx y z", "not a number: correct it or export again"),
        ("ANGL=45", "ANGL=45\n12.5", "line 5: 32 values, expected 31 from 400"),
    ],
)
def test_damaged_entries_are_told_with_their_line(
    old: str, new: str, told: str
) -> None:
    text = (HEAD + measurement()).replace("\r\n", "\n")

    assert told in refusal(text.replace(old, new))


def test_doubled_angle_is_told_with_both_lines() -> None:
    text = HEAD + measurement() + measurement(seed=1)

    assert "geometry 45 stands twice in one reading, before as 45 in line 5" in refusal(
        text
    )


def test_cut_file_is_told() -> None:
    text = (HEAD + measurement())[:-60]

    assert "values, expected 31 from 400 to 700 nm: export it again" in refusal(text)
