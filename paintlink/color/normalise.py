"""From what an instrument delivered to a colour specification."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from paintlink.color.spectra import reflectance_to_lab
from paintlink.errors import ReadingError
from paintlink.model import (
    SAMPLE_COUNTS,
    ColorSpec,
    Finish,
    FloatArray,
    Geometry,
    Lab,
    LabValues,
    Measurement,
    Observer,
    Provenance,
    Reading,
    Sample,
    Spectra,
    Spectrum,
)

ILLUMINATION_DEG = 45.0
SOLID_ANGLES_DEG = (15.0, 45.0, 110.0)
STANDARD_SETS_DEG = (
    (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0),
    (15.0, 25.0, 45.0, 75.0, 110.0),
    (15.0, 45.0, 110.0),
)
"""Angle sets of the paint trade, largest first, for readings with other counts."""

SINGLE_ANGLE_NOTE = "single angle, solid"


def normalise(
    reading: Reading,
    *,
    name: str = "",
    finish: Finish = "unknown",
    observer: Observer = "10",
) -> ColorSpec:
    """Colour specification of a reading, Lab D65 for ``observer``.

    Only geometries with 45 degree illumination in the plane of incidence count. Three,
    five or six of them are kept as they are; from any other number the largest
    standard angle set they contain. Lab comes from the spectra where there are any,
    else from the instrument, which must have computed it for the same conditions.

    A single angle is accepted for solids only, which look the same from every angle:
    its Lab is given at 15, 45 and 110 degrees, the data mode says so, and the spectrum
    stays at the angle it was measured at.

    Parameters
    ----------
    name
        Name of the colour; what the operator called the sample when left out.

    Raises
    ------
    ReadingError
        When angles are missing or doubled, when spectra are implausible or on another
        wavelength scale, or when Lab was computed for other conditions.
    SpecError
        When Lab lies outside what any paint can have.
    """
    measurement = reading.measurement
    rows = _rows(measurement, finish)
    lab = _lab(measurement, rows, observer)
    angles = [measurement.geometries[row].aspecular_deg for row in rows]
    return ColorSpec(
        name=name or reading.sample,
        samples=_samples(angles, lab),
        finish=finish,
        observer=observer,
        gloss=measurement.gloss,
        spectra=_spectra(measurement.spectra, rows, angles),
        texture=measurement.texture,
        provenance=_provenance(reading, single_angle=len(rows) == 1),
    )


def _rows(measurement: Measurement, finish: Finish) -> list[int]:
    """Rows of the measurement to keep, by ascending aspecular angle."""
    by_angle = _rows_by_angle(measurement)
    angles = sorted(by_angle)
    if len(angles) == 1 and finish != "solid":
        raise _single_angle(angles[0], finish)
    if len(angles) not in (1, *SAMPLE_COUNTS):
        angles = _standard_set(measurement, angles)
    return [by_angle[angle] for angle in angles]


def _rows_by_angle(measurement: Measurement) -> dict[float, int]:
    rows: dict[float, int] = {}
    for row, geometry in enumerate(measurement.geometries):
        angle = geometry.aspecular_deg
        if not _in_plane(geometry):
            continue
        if angle in rows:
            raise _doubled(measurement.geometries[rows[angle]], geometry)
        rows[angle] = row
    return rows


def _in_plane(geometry: Geometry) -> bool:
    return geometry.illumination_deg == ILLUMINATION_DEG and geometry.azimuth_deg == 0.0


def _standard_set(measurement: Measurement, angles: Sequence[float]) -> list[float]:
    for standard in STANDARD_SETS_DEG:
        if set(standard) <= set(angles):
            return list(standard)
    usable = ", ".join(f"{angle:g}" for angle in angles) or "none"
    msg = (
        f"the reading has {len(measurement.geometries)} geometries; in plane under 45 "
        f"degree illumination it holds the aspecular angles {usable}: a specification "
        "needs 3, 5 or 6, such as 15, 45 and 110"
    )
    raise ReadingError(msg)


def _single_angle(angle: float, finish: Finish) -> ReadingError:
    msg = (
        f"the reading holds one angle, {angle:g} degrees aspecular, and the finish is "
        f"{finish}: declare the paint solid, or measure it with a multi-angle "
        "instrument"
    )
    return ReadingError(msg)


def _doubled(first: Geometry, second: Geometry) -> ReadingError:
    msg = (
        f"the reading holds two values at {first.aspecular_deg:g} degrees aspecular "
        f"(codes {first.code!r} and {second.code!r}): average them or keep one"
    )
    return ReadingError(msg)


def _lab(measurement: Measurement, rows: list[int], observer: Observer) -> FloatArray:
    if measurement.spectra is None:
        return _instrument_lab(measurement.lab, observer)[rows]
    scale = measurement.spectra.wavelengths_nm
    factors = measurement.spectra.factors[rows]
    return reflectance_to_lab(scale, factors, "D65", observer)


def _instrument_lab(values: LabValues | None, observer: Observer) -> FloatArray:
    if values is None:
        msg = "the reading holds neither spectra nor Lab values"
        raise ReadingError(msg)
    if (values.illuminant, values.observer) != ("D65", observer):
        msg = (
            f"the instrument computed Lab for {values.illuminant}/{values.observer}, "
            f"the specification needs D65/{observer}: Lab cannot be converted, so set "
            "the instrument to these conditions or let it send spectra"
        )
        raise ReadingError(msg)
    return values.lab


def _samples(angles: list[float], lab: FloatArray) -> tuple[Sample, ...]:
    if len(angles) == 1:
        angles, lab = list(SOLID_ANGLES_DEG), np.repeat(lab, 3, axis=0)
    pairs = zip(angles, lab.tolist(), strict=True)
    return tuple(Sample(angle, Lab(*row)) for angle, row in pairs)


def _spectra(
    spectra: Spectra | None, rows: list[int], angles: list[float]
) -> tuple[Spectrum, ...]:
    if spectra is None:
        return ()
    start, second = spectra.wavelengths_nm[:2].tolist()
    return tuple(
        Spectrum(angle, start, second - start, tuple(spectra.factors[row].tolist()))
        for row, angle in zip(rows, angles, strict=True)
    )


def _provenance(reading: Reading, *, single_angle: bool) -> Provenance:
    measurement = reading.measurement
    notes = [measurement.data_mode, SINGLE_ANGLE_NOTE if single_angle else ""]
    return Provenance(
        instrument=reading.instrument,
        taken_at=reading.taken_at,
        origin=reading.origin,
        averaged=measurement.averaged,
        calibration=reading.calibration.state,
        data_mode="; ".join(note for note in notes if note),
    )
