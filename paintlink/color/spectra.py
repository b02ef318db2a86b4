"""Reflectance spectra to Lab by ASTM E308 weights.

Accepted: exactly 400-700 nm in steps of 10 nm (31 bands) or 20 nm (16 bands). A longer
or shifted range is refused rather than cut or padded here, because either changes Lab
without a word; whoever imports the data cuts it to 400-700 nm knowingly.
"""

from __future__ import annotations

import csv
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.lab import xyz_to_lab
from paintlink.errors import ReadingError
from paintlink.model import FloatArray, Illuminant, Observer

FACTOR_RANGE = (-0.02, 20.0)
"""From the dark noise of an instrument to 2000 %, well above any flake paint."""

ACCEPTED = "400 to 700 nm in steps of 10 nm (31 values) or 20 nm (16 values)"


class WeightTable(NamedTuple):
    """ASTM E308 weights, shape (bands, 3), and their column sums, the white."""

    weights: FloatArray
    white: FloatArray


def weights(illuminant: Illuminant, observer: Observer, step_nm: float) -> FloatArray:
    """ASTM E308 weights from 400 to 700 nm, ends folded in, shape (bands, 3).

    ``factors @ weights`` is XYZ with Y = 100 for reflectance factors of 1.0.
    """
    return _table(illuminant, observer, step_nm).weights


def white(illuminant: Illuminant = "D65", observer: Observer = "10") -> FloatArray:
    """XYZ of the perfect diffuser, shape (3,): the column sums of the 10 nm weights."""
    return _table(illuminant, observer, 10).white


def reflectance_to_lab(
    wavelengths_nm: ArrayLike,
    factors: ArrayLike,
    illuminant: Illuminant = "D65",
    observer: Observer = "10",
) -> FloatArray:
    """Lab of reflectance spectra: shape (3,) for one, (n, 3) for n of them.

    Parameters
    ----------
    wavelengths_nm
        400 to 700 in steps of 10 or 20, shape (bands,).
    factors
        Reflectance factors, 1.0 = 100 %, shape (bands,) or (n, bands). Values above
        1 are right for effect paints and lead to L* above 100.

    Raises
    ------
    ReadingError
        For any other wavelength scale, a count that does not fit, and factors that
        no surface has: not finite, below -0.02, or above 20.

    References
    ----------
    ASTM E308-18 and E2022; end bands folded, no bandpass correction.
    """
    scale = np.asarray(wavelengths_nm, dtype=np.float64)
    factors = np.asarray(factors, dtype=np.float64)
    step_nm = _steps().get(scale.tobytes())
    if step_nm is None:
        raise _wrong_scale(scale)
    if factors.shape[-1:] != scale.shape:
        raise _wrong_count(scale, factors)
    if not _possible(factors):
        raise _impossible_factor(scale, factors)
    table = _table(illuminant, observer, step_nm)
    return xyz_to_lab(factors @ table.weights, table.white)


def _possible(factors: FloatArray) -> bool:
    # A NaN fails both comparisons; the initial 0 lets an empty set of spectra pass.
    lowest = np.minimum.reduce(factors, axis=None, initial=0.0)
    highest = np.maximum.reduce(factors, axis=None, initial=0.0)
    return bool(lowest >= FACTOR_RANGE[0] and highest <= FACTOR_RANGE[1])


@cache
def _table(illuminant: str, observer: str, step_nm: float) -> WeightTable:
    try:
        return _tables()[illuminant, observer, step_nm]
    except KeyError:
        known = ", ".join(sorted({f"{key[0]}/{key[1]}" for key in _tables()}))
        msg = (
            f"no weights for {illuminant}/{observer} in steps of {step_nm:g} nm: "
            f"known are {known}, each for {ACCEPTED}"
        )
        raise ReadingError(msg) from None


@cache
def _tables() -> dict[tuple[str, str, float], WeightTable]:
    text = files("paintlink.color").joinpath("data", "weights.csv").read_text("ascii")
    rows: dict[tuple[str, str, float], list[list[float]]] = {}
    for row in csv.DictReader(line for line in text.splitlines() if line[0] != "#"):
        key = row["illuminant"], row["observer"], float(row["step_nm"])
        rows.setdefault(key, []).append([float(row[axis]) for axis in "XYZ"])
    return {key: _read_only(np.array(values)) for key, values in rows.items()}


def _read_only(weights: FloatArray) -> WeightTable:
    table = WeightTable(weights, weights.sum(axis=0))
    for array in table:
        array.setflags(write=False)
    return table


@cache
def _steps() -> dict[bytes, float]:
    """Step of each accepted wavelength scale, looked up by the bytes of the scale."""
    scales = {step: np.arange(400.0, 701.0, step) for step in (10.0, 20.0)}
    return {scale.tobytes(): step for step, scale in scales.items()}


def _wrong_scale(scale: FloatArray) -> ReadingError:
    msg = (
        f"the spectrum covers {_describe(scale)}; accepted is {ACCEPTED}: set the "
        "instrument or the export to that range, or cut a longer range to it"
    )
    return ReadingError(msg)


def _describe(scale: FloatArray) -> str:
    if scale.ndim != 1 or scale.size < 2 or not np.isfinite(scale).all():
        return f"no wavelength scale ({scale.size} values, shape {scale.shape})"
    steps = np.diff(scale)
    even = np.allclose(steps, steps[0], rtol=0.0, atol=1e-6)
    step = f"steps of {steps[0]:g}" if even else "uneven steps"
    return f"{scale[0]:g} to {scale[-1]:g} nm in {step} nm, {scale.size} values"


def _wrong_count(scale: FloatArray, factors: FloatArray) -> ReadingError:
    found = factors.shape[-1] if factors.ndim else 0
    msg = (
        f"{found} reflectance factors do not fit the {scale.size} wavelengths from "
        f"{scale[0]:g} to {scale[-1]:g} nm: check that no band is missing or doubled"
    )
    return ReadingError(msg)


def _impossible_factor(scale: FloatArray, factors: FloatArray) -> ReadingError:
    table = factors.reshape(-1, scale.size)
    low, high = FACTOR_RANGE
    row, band = np.argwhere(~((table >= low) & (table <= high)))[0]
    value = table[row, band]
    where = f"reflectance factor {value:g} at {scale[band]:g} nm, spectrum {row + 1}"
    if value > high and np.isfinite(value):
        advice = "looks like percent: divide by 100 where the file or device is read"
    else:
        advice = f"must lie between {low:g} and {high:g}: calibrate and measure again"
    return ReadingError(f"{where}, {advice}")
