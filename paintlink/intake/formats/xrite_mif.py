"""X-Rite MIF: sections FILE INFO, CUSTOMER, STANDARD and MEASUREMENT.

Known from one published example with a single angle and 31 values; how the values are
spelled elsewhere is not, so a list under one key, one key for each wavelength, and bare
rows of numbers are all read. Several angles of one standard make one reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, assemble
from paintlink.intake.conditions import Scale
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.geometries import read_geometry
from paintlink.intake.ini import Entry, Section, number_list, sections
from paintlink.intake.source import Source
from paintlink.intake.text import plain
from paintlink.model import Geometry, Instrument, Measurement, Reading

INFO = ImporterInfo("xrite_mif", "X-Rite MIF")

BANDS_NM = tuple(float(band) for band in range(400, 701, 10))
MAX_ROWS = 100
# No 45 degree reading reaches 120 %, and hardly a paint stays below 2 % everywhere.
HIGHEST_FRACTION, LOWEST_PERCENT = 1.2, 2.0

_BAND_KEY = re.compile(r"(?:R|NM|R_)?([4-7]\d0)")
_NAME_KEYS = ("NAME", "STANDARD", "DESC", "DESCRIPTION", "ID")


def sniff(source: Source) -> Certainty:
    """Sure of a section of file information and one of a measurement."""
    text = source.head.upper()
    known = "[FILE INFO]" in text and (
        "[MEASUREMENT" in text or "[STANDARD" in text or "[CUSTOMER" in text
    )
    return Certainty.SURE if known else Certainty.NO


@dataclass
class _Sample:
    """The measurements under one standard."""

    name: str
    line: int
    sections: list[Section]


def read(source: Source, options: Options) -> Contents:
    """One reading for each standard that has measurements."""
    samples = [one for one in _samples(source) if one.sections]
    notes: dict[str, None] = {NO_TIME: None}
    if source.decoded.note:
        notes[source.decoded.note] = None
    colours = [_colour(source, sample, options, notes) for sample in samples]
    return Contents(tuple(colours), notes=tuple(notes))


def _samples(source: Source) -> Iterator[_Sample]:
    sample: _Sample | None = None
    for section in sections(source):
        if section.name.startswith("STANDARD"):
            if sample is not None:
                yield sample
            sample = _Sample(plain(section.text(*_NAME_KEYS)), section.line, [])
        elif section.name.startswith("MEASUREMENT"):
            sample = sample or _Sample("", section.line, [])
            sample.sections.append(section)
    if sample is not None:
        yield sample


def _colour(
    source: Source, sample: _Sample, options: Options, notes: dict[str, None]
) -> Colour:
    rows = [_row(source, section, options) for section in sample.sections]
    scale = options.scale or _scale(source, rows, notes)
    values = assemble(source, rows, Scales(wavelengths_nm=BANDS_NM, scale=scale))
    notes |= {f"{sample.name}: {note}": None for note in values.notes}
    first = sample.sections[0]
    averaged = first.text("AVGS")
    known = averaged.isascii() and averaged.isdecimal() and 1 <= len(averaged) < 3
    measurement = Measurement(
        values.geometries,
        values.spectra,
        averaged=max(1, int(averaged)) if known else 1,
        data_mode=options.data_mode,
        raw="\n".join(_lines(one) for one in sample.sections).encode(),
    )
    reading = Reading(
        measurement,
        Instrument("X-Rite", plain(first.text("INST"), 60) or "unknown"),
        options.received_at,
        "real",
        sample=sample.name or f"measurement in line {first.line}",
    )
    return Colour(reading)


def _row(source: Source, section: Section, options: Options) -> Row:
    where = f"line {section.line}"
    factors = _factors(source, section)
    if len(factors) != len(BANDS_NM):
        msg = f"{len(factors)} values, expected 31 from 400 to 700 nm: export it again"
        raise source.fault(where, msg)
    return Row(where, _geometry(source, section, options), factors=factors)


def _factors(source: Source, section: Section) -> list[float]:
    keyed = {
        found[1]: entry
        for key, entry in section.entries.items()
        if (found := _BAND_KEY.fullmatch(key))
    }
    if keyed:
        ordered = [keyed[band] for band in sorted(keyed)]
        return [value for one in ordered for value in number_list(source, one)]
    lists = [
        e for e in section.entries.values() if len(re.split(r"[,;\s]+", e.text)) > 9
    ]
    rows: list[Entry] = [*lists[:1], *([] if lists else section.bare[:MAX_ROWS])]
    return [value for row in rows for value in number_list(source, row)]


def _geometry(source: Source, section: Section, options: Options) -> Geometry:
    entry = section.entries.get("ANGL")
    code = entry.text if entry and entry.text else options.geometry
    if not code:
        msg = "no ANGL in the measurement: add it, or declare --geometry 45as45"
        raise source.fault(f"line {section.line}", msg)
    try:
        return read_geometry(plain(code, 60))
    except InputError as error:
        raise source.fault(f"line {section.line}", str(error)) from error


def _scale(source: Source, rows: list[Row], notes: dict[str, None]) -> Scale:
    """The scale, which the format does not state, told by the brightest value."""
    highest = max(max(row.factors or [0.0]) for row in rows)
    if HIGHEST_FRACTION < highest <= LOWEST_PERCENT:
        msg = (
            "the values may be percent or fractions: say --scale percent or "
            "--scale fraction"
        )
        raise source.fault(rows[0].where, msg, f"{highest:g} at most")
    scale: Scale = "fraction" if highest <= HIGHEST_FRACTION else "percent"
    notes[f"values taken as {scale}; the file does not say"] = None
    return scale


def _lines(section: Section) -> str:
    entries = [f"{key}={entry.text}" for key, entry in section.entries.items()]
    return "\n".join([*entries, *(row.text for row in section.bare)])
