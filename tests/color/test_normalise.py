from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest

from paintlink.color import normalise, reflectance_to_lab, travel
from paintlink.errors import ReadingError, SpecError
from paintlink.model import (
    Calibration,
    Geometry,
    Gloss,
    Instrument,
    LabValues,
    Measurement,
    Reading,
    Spectra,
    Texture,
)

TEN = np.arange(400.0, 701.0, 10.0)
FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
SIX = (-15.0, *FIVE)
AT = datetime(2026, 3, 4, 5, 6, 7, tzinfo=UTC)


def geometries(*aspecular_deg: float) -> tuple[Geometry, ...]:
    return tuple(Geometry(angle, code=f"45as{angle:g}") for angle in aspecular_deg)


def spectra(count: int) -> Spectra:
    level = np.linspace(1.4, 0.1, count)[:, np.newaxis]
    return Spectra(TEN, level * np.linspace(0.5, 1.0, 31))


def lab_values(count: int, illuminant="D65", observer="10") -> LabValues:
    lab = np.arange(3.0 * count).reshape(count, 3) + 10.0
    return LabValues(lab, illuminant, observer)


def reading(where: tuple[Geometry, ...], **values) -> Reading:
    if not values.keys() & {"spectra", "lab"}:
        values["spectra"] = spectra(len(where))
    return Reading(
        measurement=Measurement(where, **values),
        instrument=Instrument("Maker", "MA99", "123", "1.0"),
        taken_at=AT,
        origin="simulated",
        calibration=Calibration("valid", AT),
        sample="door 7",
    )


def twelve_angles() -> tuple[Geometry, ...]:
    flat = [Geometry(angle, 15.0) for angle in (-45, -30, -15, 15, 45, 80)]
    return (*flat, *geometries(*reversed(SIX)))


@pytest.mark.parametrize(
    "angles", [(15.0, 45.0, 110.0), (25.0, 45.0, 75.0), FIVE, SIX], ids=len
)
def test_measured_angles_are_kept(angles):
    source = reading(geometries(*angles))

    spec = normalise(source)

    assert spec.angles_deg == angles
    expected = reflectance_to_lab(TEN, source.measurement.spectra.factors)
    assert spec.lab() == pytest.approx(expected, abs=1e-12)


def test_spectra_travel_with_their_angles():
    source = reading(geometries(110.0, 45.0, 15.0))

    spec = normalise(source)

    assert [spectrum.aspecular_deg for spectrum in spec.spectra] == [15.0, 45.0, 110.0]
    assert {(s.start_nm, s.step_nm, len(s.factors)) for s in spec.spectra} == {
        (400.0, 10.0, 31)
    }
    first = source.measurement.spectra.factors[2]
    assert spec.spectra[0].factors == tuple(first)
    assert spec.lab(15.0)[0] == pytest.approx(reflectance_to_lab(TEN, first))


def test_everything_worth_knowing_is_copied():
    texture = (Texture("S_i", 4.5, 15.0),)
    source = reading(
        geometries(*FIVE),
        spectra=spectra(5),
        gloss=Gloss(88.0, 60.0),
        texture=texture,
        averaged=3,
        data_mode="DP",
    )

    spec = normalise(source, finish="pearl")

    assert (spec.name, spec.finish, spec.observer) == ("door 7", "pearl", "10")
    assert (spec.gloss, spec.texture) == (Gloss(88.0, 60.0), texture)
    provenance = spec.provenance
    assert provenance.instrument == source.instrument
    assert (provenance.taken_at, provenance.origin) == (AT, "simulated")
    assert (provenance.averaged, provenance.calibration) == (3, "valid")
    assert provenance.data_mode == "DP"


def test_given_name_wins_over_sample():
    assert normalise(reading(geometries(*FIVE)), name="blue").name == "blue"


def test_observer_changes_lab_from_spectra():
    source = reading(geometries(*FIVE))

    spec = normalise(source, observer="2")

    factors = source.measurement.spectra.factors
    assert spec.observer == "2"
    assert spec.lab() == pytest.approx(reflectance_to_lab(TEN, factors, "D65", "2"))


def test_matching_instrument_lab_is_taken():
    spec = normalise(reading(geometries(110, 45, 15), lab=lab_values(3)))

    assert spec.lab(15.0, 110.0).tolist() == [[16, 17, 18], [10, 11, 12]]
    assert spec.spectra == ()


@pytest.mark.parametrize(
    ("illuminant", "observer", "wanted"),
    [("D65", "2", "10"), ("A", "10", "10"), ("D65", "10", "2")],
)
def test_foreign_instrument_lab_is_refused(illuminant, observer, wanted):
    source = reading(geometries(*FIVE), lab=lab_values(5, illuminant, observer))
    message = f"for {illuminant}/{observer}, the specification needs D65/{wanted}.*set"

    with pytest.raises(ReadingError, match=message):
        normalise(source, observer=wanted)


def test_spectra_win_over_instrument_lab():
    both = {"spectra": spectra(5), "lab": lab_values(5, "A", "2")}

    spec = normalise(reading(geometries(*FIVE), **both))

    expected = reflectance_to_lab(TEN, both["spectra"].factors)
    assert spec.lab() == pytest.approx(expected)


def test_twelve_angle_set_keeps_six():
    source = reading(twelve_angles())

    spec = normalise(source)

    assert spec.angles_deg == SIX
    factors = source.measurement.spectra.factors
    assert spec.lab(-15.0)[0] == pytest.approx(reflectance_to_lab(TEN, factors[11]))


@pytest.mark.parametrize(
    ("angles", "kept"),
    [
        ((15, 45, 75, 110), (15, 45, 110)),
        ((*SIX, 60), SIX),
        ((*FIVE, 60, 90), FIVE),
    ],
)
def test_unusual_counts_keep_standard_set(angles, kept):
    assert normalise(reading(geometries(*angles))).angles_deg == kept


def test_out_of_plane_values_are_left_out():
    aside = Geometry(15.0, azimuth_deg=90.0, code="45as15az90")

    spec = normalise(reading((*geometries(15, 45, 110), aside)))

    assert spec.angles_deg == (15.0, 45.0, 110.0)


@pytest.mark.parametrize(
    ("where", "message"),
    [
        (
            geometries(45, 110),
            "has 2 geometries.* aspecular angles 45, 110: .* 3, 5 or",
        ),
        (geometries(25, 45, 75, 90), "aspecular angles 25, 45, 75, 90"),
        ((Geometry(45.0, 0.0),), "aspecular angles none"),
    ],
)
def test_unusable_angles_are_named(where, message):
    with pytest.raises(ReadingError, match=message):
        normalise(reading(where))


def test_doubled_geometry_is_refused():
    reversed_path = Geometry(15.0, code="r45as15")

    with pytest.raises(
        ReadingError, match=r"two values at 15 .*'45as15' and 'r45as15'"
    ):
        normalise(reading((*geometries(*FIVE), reversed_path)))


@pytest.mark.parametrize("finish", ["metallic", "pearl", "unknown"])
def test_single_angle_needs_a_solid(finish):
    source = reading(geometries(45))

    with pytest.raises(ReadingError, match=f"one angle, 45 .* is {finish}: declare"):
        normalise(source, finish=finish)


@pytest.mark.parametrize(
    ("data_mode", "noted"),
    [("", "single angle, solid"), ("SCI", "SCI; single angle, solid")],
)
def test_single_angle_solid_says_so(data_mode, noted):
    source = reading(geometries(45), spectra=spectra(1), data_mode=data_mode)

    spec = normalise(source, finish="solid")

    assert spec.angles_deg == (15.0, 45.0, 110.0)
    assert len(np.unique(spec.lab(), axis=0)) == 1
    assert [spectrum.aspecular_deg for spectrum in spec.spectra] == [45.0]
    assert spec.provenance.data_mode == noted
    assert travel(spec).flop_index == 0.0


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (45.0, "45 at 550 nm, spectrum 3, looks like percent"),
        (-0.5, "-0.5 at 550 nm, spectrum 3, must lie between"),
    ],
)
def test_implausible_spectra_are_refused(value, message):
    factors = spectra(5).factors.copy()
    factors[2, 15] = value
    source = reading(geometries(*FIVE), spectra=Spectra(TEN, factors))

    with pytest.raises(ReadingError, match=message):
        normalise(source)


def test_other_wavelength_scale_is_refused():
    scale = np.arange(360.0, 741.0, 10.0)
    source = reading(geometries(*FIVE), spectra=Spectra(scale, np.ones((5, 39))))

    with pytest.raises(ReadingError, match="360 to 740 nm in steps of 10 nm, 39"):
        normalise(source)


def test_impossible_instrument_lab_is_refused():
    wild = replace(lab_values(3), lab=np.full((3, 3), 500.0))

    with pytest.raises(SpecError, match="L must lie between -16 and 170"):
        normalise(reading(geometries(15, 45, 110), lab=wild))


def test_reading_survives_and_repeats():
    source = reading(geometries(*FIVE))

    assert normalise(source) == normalise(source)
