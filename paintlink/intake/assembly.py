"""From the rows of a file to a measurement, with the checks that every format needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from paintlink.color import FACTOR_RANGE, cie76, reflectance_to_lab
from paintlink.errors import InputError
from paintlink.intake.conditions import Conditions, Scale
from paintlink.intake.geometries import side_of
from paintlink.intake.source import Source
from paintlink.model import FloatArray, Geometry, LabValues, Spectra

LOWEST_FACTOR, HIGHEST_FACTOR = FACTOR_RANGE
# Away from the gloss no paint reflects more than a white surface, however it sparkles.
HIGHEST_FLOOR = 2.0
DARK_PERCENT = 2.0
NOTED_DIFFERENCE = 0.3
REFUSED_DIFFERENCE = 5.0


@dataclass(frozen=True, slots=True)
class Row:
    """What a file says about one geometry; ``where`` is its place for messages."""

    where: str
    geometry: Geometry
    lab: Sequence[float] | None = None
    factors: Sequence[float] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Scales:
    """What the numbers of the rows mean."""

    wavelengths_nm: tuple[float, ...] = ()
    scale: Scale = "fraction"
    conditions: Conditions | None = None


@dataclass(frozen=True, slots=True)
class Values:
    """Values of one reading, and what its reader wants a person to know."""

    geometries: tuple[Geometry, ...]
    spectra: Spectra | None
    lab: LabValues | None
    notes: tuple[str, ...] = ()


def assemble(source: Source, rows: Sequence[Row], scales: Scales) -> Values:
    """The values of one reading.

    Raises
    ------
    InputError
        When a geometry is doubled, has less than the others, or its reflectance factors
        are on another scale or wavelength range than the rest.
    """
    rows = _one_side(rows)
    _require_once(source, rows)
    spectra, notes = _spectra(source, rows, scales)
    lab = _lab(source, rows, scales.conditions)
    notes += _disagreement(source, rows, spectra, lab)
    return Values(tuple(row.geometry for row in rows), spectra, lab, tuple(notes))


def _one_side(rows: Sequence[Row]) -> Sequence[Row]:
    """One row for an angle measured from two sides: the mean, the instrument's or ours.

    Konica Minolta's CM-M6 delivers LEFT, RIGHT and DP, double path, their mean.
    """
    sides = [side_of(row.geometry.code) for row in rows]
    if not any(sides):
        return rows
    kept = [row for row, side in zip(rows, sides, strict=True) if side in {"", "dp"}]
    angles = {row.geometry.aspecular_deg for row in kept}
    for left, side in zip(rows, sides, strict=True):
        if side != "left" or left.geometry.aspecular_deg in angles:
            continue
        for right, other in zip(rows, sides, strict=True):
            if other == "right" and _same_direction(left, right):
                kept.append(_mean(left, right))
    return kept


def _same_direction(one: Row, other: Row) -> bool:
    return replace(one.geometry, code="") == replace(other.geometry, code="")


def _mean(one: Row, other: Row) -> Row:
    code = f"{one.geometry.code}+{other.geometry.code}"
    return Row(
        one.where,
        replace(one.geometry, code=code),
        _halfway(one.lab, other.lab),
        _halfway(one.factors, other.factors),
    )


def _halfway(
    one: Sequence[float] | None, other: Sequence[float] | None
) -> Sequence[float] | None:
    if one is None or other is None or len(one) != len(other):
        return None
    return [(a + b) / 2.0 for a, b in zip(one, other, strict=True)]


def _require_once(source: Source, rows: Sequence[Row]) -> None:
    seen: dict[tuple[float, float, float], Row] = {}
    for row in rows:
        one = row.geometry
        key = (one.illumination_deg, one.aspecular_deg, one.azimuth_deg)
        if key in seen:
            first = seen[key]
            msg = (
                f"geometry {one.code} stands twice in one reading, before as "
                f"{first.geometry.code} in {first.where}: remove one of the two, or "
                "give the readings different names"
            )
            raise source.fault(row.where, msg)
        seen[key] = row


def _spectra(
    source: Source, rows: Sequence[Row], scales: Scales
) -> tuple[Spectra | None, list[str]]:
    have = [row.factors is not None and len(row.factors) > 0 for row in rows]
    if not any(have):
        return None, []
    if not all(have):
        raise _lacking(source, rows, have, "spectrum")
    cut = _visible(scales.wavelengths_nm)
    if isinstance(cut, str):
        raise source.fault(rows[0].where, cut)
    for row in rows:
        if row.factors is not None and len(row.factors) != len(scales.wavelengths_nm):
            msg = (
                f"{len(row.factors)} reflectance values for "
                f"{len(scales.wavelengths_nm)} wavelengths: export again"
            )
            raise source.fault(row.where, msg)
    factors = np.array([row.factors for row in rows], dtype=np.float64)
    _require_numbers(source, rows, factors)
    if scales.scale == "percent":
        factors /= 100.0
    _require_scale(source, rows, factors, scales.scale)
    notes = [cut.note] if cut.note else []
    if scales.scale == "percent" and factors.max() * 100.0 < DARK_PERCENT:
        notes.append(
            f"no reflectance value exceeds {DARK_PERCENT:g} %: if they are fractions, "
            "import with --scale fraction"
        )
    return Spectra(cut.wavelengths_nm, factors[:, cut.columns]), notes


def _require_numbers(source: Source, rows: Sequence[Row], values: FloatArray) -> None:
    """Refuse what a format can spell and no instrument can measure."""
    finite = np.isfinite(values).all(axis=1)
    if not finite.all():
        msg = "a value is not a finite number: correct it or export again"
        raise source.fault(rows[int(finite.argmin())].where, msg)


def _lacking(
    source: Source, rows: Sequence[Row], have: Sequence[bool], what: str
) -> InputError:
    row = rows[have.index(False)]
    msg = (
        f"geometry {row.geometry.code} has no {what} while other geometries of the "
        "reading have one: complete it or remove it everywhere"
    )
    return source.fault(row.where, msg)


def _require_scale(
    source: Source, rows: Sequence[Row], factors: FloatArray, scale: Scale
) -> None:
    lowest = factors.min(axis=1)
    if (lowest < LOWEST_FACTOR).any():
        index = int(lowest.argmin())
        msg = (
            f"reflectance of {100.0 * lowest[index]:.4g} % at "
            f"{rows[index].geometry.code}: calibrate and measure again, or correct it"
        )
        raise source.fault(rows[index].where, msg)
    away = np.array([row.geometry.aspecular_deg >= 45.0 for row in rows])
    wrong = (factors.max(axis=1) > HIGHEST_FACTOR) | (
        away & (factors.min(axis=1) > HIGHEST_FLOOR)
    )
    if not wrong.any():
        return
    index = int(wrong.argmax())
    given = factors[index].max() * (100.0 if scale == "percent" else 1.0)
    meaning = "percent" if scale == "percent" else "fractions (1 = 100 %)"
    other = "export it again" if scale == "percent" else "import with --scale percent"
    some = (
        "" if wrong.all() else "; other geometries of the reading are not: correct it"
    )
    msg = (
        f"reflectance {given:g} at {rows[index].geometry.code} is impossible when "
        f"values are {meaning}: {other}{some}"
    )
    raise source.fault(rows[index].where, msg)


@dataclass(frozen=True, slots=True)
class _Cut:
    wavelengths_nm: FloatArray
    columns: list[int]
    note: str = ""


@lru_cache(maxsize=64)
def _visible(wavelengths_nm: tuple[float, ...]) -> _Cut | str:
    """Where 400 to 700 nm lie on a scale, or why they do not."""
    for step in (10.0, 20.0):
        wanted = np.arange(400.0, 701.0, step)
        index = {value: i for i, value in enumerate(wavelengths_nm)}
        if not all(value in index for value in wanted.tolist()):
            continue
        columns = [index[value] for value in wanted.tolist()]
        if columns != sorted(columns):
            return "the wavelengths do not ascend: export again"
        note = ""
        if len(columns) != len(wavelengths_nm):
            first, last = wavelengths_nm[0], wavelengths_nm[-1]
            note = (
                f"spectra from {first:g} to {last:g} nm: 400 to 700 nm in steps of "
                f"{step:g} are used"
            )
        return _Cut(wanted, columns, note)
    given = (
        f"{len(wavelengths_nm)} wavelengths from {min(wavelengths_nm):g} to "
        f"{max(wavelengths_nm):g} nm"
        if wavelengths_nm
        else "no wavelengths"
    )
    return (
        f"the spectra have {given}; needed are 400 to 700 nm in steps of 10 or 20: "
        "export that range, or Lab only"
    )


def _lab(
    source: Source, rows: Sequence[Row], conditions: Conditions | None
) -> LabValues | None:
    have = [row.lab is not None for row in rows]
    if conditions is None or not any(have):
        return None
    if not all(have):
        raise _lacking(source, rows, have, "Lab")
    values = np.array([row.lab for row in rows], dtype=np.float64)
    _require_numbers(source, rows, values)
    return LabValues(values, conditions.illuminant, conditions.observer)


def _disagreement(
    source: Source, rows: Sequence[Row], spectra: Spectra | None, lab: LabValues | None
) -> list[str]:
    if spectra is None or lab is None:
        return []
    computed = reflectance_to_lab(
        spectra.wavelengths_nm, spectra.factors, lab.illuminant, lab.observer
    )
    difference = cie76(lab.lab, computed)
    index = int(difference.argmax())
    worst = float(difference[index])
    text = (
        f"spectrum and Lab of {rows[index].geometry.code} differ by {worst:.2f} (CIE76)"
    )
    if worst > REFUSED_DIFFERENCE:
        msg = f"{text}: check scale, column order and illuminant, or export again"
        raise source.fault(rows[index].where, msg)
    return [f"{text}: the spectrum is used"] if worst > NOTED_DIFFERENCE else []
