"""Datacolor QTX: sections of standards and batches with reflectance in percent.

Read as published programs of its users write and read it; the vendor's description is
not public. Instruments behind it see one angle, so it gives solid colours. Sections of
one name whose ``VIEWING`` are multi-angle codes are taken as one reading.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, assemble
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.geometries import read_geometry
from paintlink.intake.ini import Section, number_list, sections, whole_number
from paintlink.intake.source import Source
from paintlink.intake.text import plain
from paintlink.intake.times import from_seconds, parse_time
from paintlink.model import Geometry, Instrument, Measurement, Reading

INFO = ImporterInfo("datacolor_qtx", "Datacolor QTX")

SINGLE_NOTE = "no geometry in the file: taken as 45/0, right for solid colours only"
SPHERE_NOTE = "specular excluded by a sphere: right for solid colours only"

_DATA = re.compile(r"(STANDARD|BATCH)_DATA(?:\s+\d{1,9})?")
_PREFIX = {"STANDARD": "STD", "BATCH": "BAT"}
_INCLUDED = re.compile(r"SCI|INCL", re.IGNORECASE)
_EXCLUDED = re.compile(r"SCE|EXCL", re.IGNORECASE)


def sniff(source: Source) -> Certainty:
    """Sure of a section of standard or batch data."""
    found = re.search(r"^\s*\[(?:STANDARD|BATCH)_DATA", source.head, re.MULTILINE)
    return Certainty.SURE if found else Certainty.NO


@dataclass(frozen=True, slots=True)
class _Curve:
    """One section: a spectrum, what it is called, and where it stands."""

    name: str
    prefix: str
    section: Section
    geometry: Geometry
    wavelengths_nm: tuple[float, ...]
    factors: list[float]


def read(source: Source, options: Options) -> Contents:
    """One reading for each standard and batch."""
    notes: dict[str, None] = {}
    if source.decoded.note:
        notes[source.decoded.note] = None
    curves = list(_curves(source, options, notes))
    colours = [
        _colour(source, group, options, notes) for group in _grouped(curves).values()
    ]
    return Contents(tuple(colours), notes=tuple(notes))


def _curves(
    source: Source, options: Options, notes: dict[str, None]
) -> Iterator[_Curve]:
    for section in sections(source):
        kind = _DATA.fullmatch(section.name)
        if not kind:
            continue
        prefix = _PREFIX[kind[1]]
        factors = section.entries.get(f"{prefix}_R")
        if factors is None:
            notes["sections without reflectance left out"] = None
            continue
        values = number_list(source, factors)
        points = whole_number(source, section, f"{prefix}_REFLPOINTS", len(values))
        if points != len(values):
            msg = f"{len(values)} reflectance values where {points} are announced"
            raise source.fault(f"line {factors.line}", f"{msg}: export it again")
        low = whole_number(source, section, f"{prefix}_REFLLOW", 400)
        step = whole_number(source, section, f"{prefix}_REFLINTERVAL", 10)
        yield _Curve(
            plain(section.text(f"{prefix}_NAME")) or section.name.title(),
            prefix,
            section,
            _geometry(source, section, prefix, options, notes),
            tuple(float(low + step * band) for band in range(len(values))),
            values,
        )


def _geometry(
    source: Source,
    section: Section,
    prefix: str,
    options: Options,
    notes: dict[str, None],
) -> Geometry:
    viewing = section.text(f"{prefix}_VIEWING", f"{prefix}_SPECULAR").strip(",")
    if options.geometry:
        return read_geometry(options.geometry)
    if not viewing:
        notes[SINGLE_NOTE] = None
        return Geometry(45.0, code="unknown")
    if _INCLUDED.search(viewing):
        msg = (
            "measured with the gloss included, which no 45 degree reading is: export "
            "specular excluded (SCE), or declare it with --geometry 45as45"
        )
        raise source.fault(f"line {section.line}", msg, viewing)
    if _EXCLUDED.search(viewing):
        notes[SPHERE_NOTE] = None
        return Geometry(45.0, code=plain(viewing, 60))
    try:
        return read_geometry(plain(viewing, 60))
    except InputError as error:
        raise source.fault(f"line {section.line}", str(error)) from error


def _grouped(curves: list[_Curve]) -> dict[object, list[_Curve]]:
    """Curves of one name at different angles together, all others alone."""
    groups: dict[object, list[_Curve]] = {}
    for index, curve in enumerate(curves):
        key: object = (curve.prefix, curve.name)
        angles = [one.geometry.aspecular_deg for one in groups.get(key, [])]
        if curve.geometry.aspecular_deg in angles:
            key = index
        groups.setdefault(key, []).append(curve)
    return groups


def _colour(
    source: Source, curves: list[_Curve], options: Options, notes: dict[str, None]
) -> Colour:
    first = curves[0]
    if any(one.wavelengths_nm != first.wavelengths_nm for one in curves):
        msg = "the angles of one reading are on different wavelengths: export again"
        raise source.fault(f"line {first.section.line}", msg)
    rows = [
        Row(f"line {one.section.line}", one.geometry, factors=one.factors)
        for one in curves
    ]
    scales = Scales(
        wavelengths_nm=first.wavelengths_nm, scale=options.scale or "percent"
    )
    values = assemble(source, rows, scales)
    notes |= {f"{first.name}: {note}": None for note in values.notes}
    measurement = Measurement(
        values.geometries,
        values.spectra,
        data_mode=options.data_mode,
        raw="\n".join(_lines(one) for one in curves).encode(),
    )
    model = plain(first.section.text(f"{first.prefix}_INSTRUMENT"), 60)
    reading = Reading(
        measurement,
        Instrument("unknown", model or "unknown"),
        _time(source, first, options, notes),
        "real",
        sample=first.name,
    )
    return Colour(reading)


def _lines(curve: _Curve) -> str:
    entries = curve.section.entries.items()
    return "\n".join(f"{key}={entry.text}" for key, entry in entries)


def _time(
    source: Source, curve: _Curve, options: Options, notes: dict[str, None]
) -> datetime:
    entry = curve.section.entries.get(f"{curve.prefix}_DATETIME")
    text = entry.text.strip(", ") if entry else ""
    if entry is None or text in {"", "0"}:
        notes[NO_TIME] = None
        return options.received_at
    try:
        if text.isascii() and text.isdecimal():
            return from_seconds(float(text[:15]))
        return parse_time(text, options.zone)
    except InputError as error:
        raise source.fault(f"line {entry.line}", str(error), text) from error
