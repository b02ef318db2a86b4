"""Several measurements of one sample as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from paintlink.color import cie76, reflectance_to_lab
from paintlink.errors import ReadingError
from paintlink.model import FloatArray, LabValues, Measurement, Spectra

# Start values: near the mirror angle the hand that holds the instrument shows more.
NEAR_DEG, NEAR_dE, FAR_dE = 20.0, 2.0, 1.0
EXTRA_READINGS = 2


def average(measurements: Sequence[Measurement]) -> Measurement:
    """The mean of each value over the measurements; their raw bytes one after another.

    Raises
    ------
    ReadingError
        When they were not taken at the same geometries, in the same data mode, with
        the same conditions and wavelengths.
    """
    first = measurements[0]
    if len(measurements) == 1:
        return first
    if any(one.geometries != first.geometries for one in measurements):
        msg = "readings of one sample were taken at different geometries: take it again"
        raise ReadingError(msg)
    _require_alike(measurements)
    return replace(
        first,
        spectra=_mean_spectra(measurements),
        lab=_mean_lab(measurements),
        averaged=sum(one.averaged for one in measurements),
        raw=b"".join(one.raw for one in measurements),
        spread=tuple(_distances(measurements).max(axis=0).tolist()),
    )


def outlier(measurements: Sequence[Measurement]) -> str:
    """Why one more reading is wanted; empty when the readings agree.

    They do when no reading lies further from their mean than CIE76 1.0, or 2.0 at
    aspecular angles up to 20 degrees.
    """
    if len(measurements) < 2:
        return ""
    largest = _distances(measurements).max(axis=0)
    for geometry, difference in zip(measurements[0].geometries, largest, strict=True):
        limit = NEAR_dE if abs(geometry.aspecular_deg) <= NEAR_DEG else FAR_dE
        if difference > limit:
            return (
                f"the readings differ by dE {difference:.1f} at "
                f"{geometry.aspecular_deg:g} degrees, allowed is {limit:g}"
            )
    return ""


def without_farthest(measurements: Sequence[Measurement]) -> list[Measurement]:
    """The measurements but the one that lies farthest from the median of all."""
    lab = np.stack([lab_of(one) for one in measurements])
    distances = cie76(np.median(lab, axis=0), lab).sum(axis=1)
    farthest = int(np.argmax(distances))
    return [one for place, one in enumerate(measurements) if place != farthest]


def _distances(measurements: Sequence[Measurement]) -> FloatArray:
    """CIE76 to the mean, shape (measurements, geometries)."""
    lab = np.stack([lab_of(one) for one in measurements])
    return cie76(lab.mean(axis=0), lab)


def lab_of(measurement: Measurement) -> FloatArray:
    """Lab D65, observer 10, of each geometry, shape (geometries, 3)."""
    if measurement.lab is not None:
        return measurement.lab.lab
    spectra = measurement.spectra
    if spectra is None:
        msg = "the reading holds neither spectra nor Lab values"
        raise ReadingError(msg)
    return reflectance_to_lab(spectra.wavelengths_nm, spectra.factors)


def _require_alike(measurements: Sequence[Measurement]) -> None:
    modes = sorted({one.data_mode or "none" for one in measurements})
    if len(modes) > 1:
        msg = (
            f"readings of one sample were taken in the data modes {', '.join(modes)}, "
            "which give different numbers for one panel: take it again in one mode"
        )
        raise ReadingError(msg)
    if len({_conditions(one) for one in measurements}) > 1:
        msg = (
            "readings of one sample hold Lab or spectra of different kinds: take it "
            "again with the same settings"
        )
        raise ReadingError(msg)


def _conditions(measurement: Measurement) -> tuple[object, ...]:
    spectra, lab = measurement.spectra, measurement.lab
    return (
        spectra and spectra.wavelengths_nm.tobytes(),
        lab and (lab.illuminant, lab.observer),
    )


def _mean_spectra(measurements: Sequence[Measurement]) -> Spectra | None:
    spectra = [one.spectra for one in measurements if one.spectra is not None]
    if not spectra:
        return None
    factors = np.mean([one.factors for one in spectra], axis=0)
    return Spectra(spectra[0].wavelengths_nm, factors)


def _mean_lab(measurements: Sequence[Measurement]) -> LabValues | None:
    values = [one.lab for one in measurements if one.lab is not None]
    if not values:
        return None
    lab = np.mean([one.lab for one in values], axis=0)
    return replace(values[0], lab=lab)
