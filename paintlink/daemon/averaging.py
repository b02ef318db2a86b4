"""Several measurements of one sample as one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from paintlink.errors import ReadingError
from paintlink.model import LabValues, Measurement, Spectra


def average(measurements: Sequence[Measurement]) -> Measurement:
    """The mean of each value over the measurements; their raw bytes one after another.

    Raises
    ------
    ReadingError
        When they were not taken at the same geometries.
    """
    first = measurements[0]
    if len(measurements) == 1:
        return first
    if any(one.geometries != first.geometries for one in measurements):
        msg = "readings of one sample were taken at different geometries: take it again"
        raise ReadingError(msg)
    return replace(
        first,
        spectra=_mean_spectra(measurements),
        lab=_mean_lab(measurements),
        averaged=sum(one.averaged for one in measurements),
        raw=b"".join(one.raw for one in measurements),
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
