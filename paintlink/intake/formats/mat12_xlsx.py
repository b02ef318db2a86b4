"""X-Rite MA-T12 quality control export: a workbook with Lab and spectra.

Layout as found in workbooks published by users of the instrument: sheets
``Color Data`` and ``Spectral Data``, one row per geometry under a heading row that
names Geometry; the heading rows of the two differ in height. Factors are fractions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from datetime import datetime

from paintlink.errors import InputError
from paintlink.intake.assembly import Row, Scales, Values, assemble
from paintlink.intake.conditions import Conditions, split_conditions
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.formats._mat12_sheet import Place, Sheet, full
from paintlink.intake.geometries import read_geometry
from paintlink.intake.source import Source
from paintlink.intake.text import plain
from paintlink.intake.times import to_utc
from paintlink.intake.workbook import ZIP_MARK, Workbook, member_names
from paintlink.model import Geometry, Instrument, Measurement, Reading, Texture

INFO = ImporterInfo("mat12_xlsx", "X-Rite MA-T12 quality control workbook (XLSX)")

COLOR, SPECTRAL, TEXTURE = "Color Data", "Spectral Data", "Texture Data"
INSTRUMENT = Instrument("X-Rite", "MA-T12")

Key = tuple[str, datetime | None]


def sniff(source: Source) -> Certainty:
    """Sure of every workbook: no other importer reads one."""
    if not source.data.startswith(ZIP_MARK):
        return Certainty.NO
    is_workbook = "xl/workbook.xml" in member_names(source)
    return Certainty.SURE if is_workbook else Certainty.NO


def read(source: Source, options: Options) -> Contents:
    """One reading for each name and time in the workbook."""
    book = Workbook(source)
    sheets = {name: Sheet(source, book, name) for name in (COLOR, SPECTRAL)}
    if not any(sheet.rows for sheet in sheets.values()):
        names = ", ".join(book.names) or "none"
        msg = (
            f"a workbook without readings in the sheets {COLOR!r} or {SPECTRAL!r} "
            f"(sheets: {names}): export QC data, or save a table as CSV and import it "
            "with a profile"
        )
        raise source.fault("", msg)
    conditions = _conditions(source, sheets[COLOR])
    samples = _samples(source, sheets)
    textures = _textures(source, book)
    colours: list[Colour] = []
    notes: list[str] = []
    for key, places in samples.items():
        rows = _rows(places, sheets)
        scales = Scales(
            wavelengths_nm=sheets[SPECTRAL].wavelengths_nm,
            scale=options.scale or "fraction",
            conditions=conditions,
        )
        values = assemble(source, rows, scales)
        notes += [f"{key[0]}: {note}" for note in values.notes]
        notes += [] if key[1] else [NO_TIME]
        reading = _reading(source, key, values, textures.get(key, ()), options)
        colours.append(Colour(reading))
    return Contents(tuple(colours), notes=tuple(notes))


@dataclass
class _Sample:
    """Rows of one reading by geometry code, in each of the two sheets."""

    color: dict[str, Place] = field(default_factory=dict)
    spectral: dict[str, Place] = field(default_factory=dict)


def _conditions(source: Source, sheet: Sheet) -> Conditions | None:
    """Conditions of the Lab columns: in the cell above them, else in their heading."""
    if not sheet.rows:
        return None
    for number, cells in enumerate(sheet.above, start=1):
        if str(cells[0]).strip().upper().startswith("ILLUMINANT") and len(cells) > 1:
            where, text = f"sheet {sheet.name!r}, cell B{number}", str(cells[1])
            break
    else:
        heading = sheet.heading[sheet.column("L*")]
        where, text = f"sheet {sheet.name!r}, heading", heading[heading.find("(") + 1 :]
    try:
        return split_conditions(text.strip(" )"))
    except InputError as error:
        raise source.fault(where, str(error)) from error


def _samples(source: Source, sheets: dict[str, Sheet]) -> dict[Key, _Sample]:
    samples: dict[Key, _Sample] = {}
    for name, sheet in sheets.items():
        for place, key, code in _keyed(source, sheet):
            sample = samples.setdefault(key, _Sample())
            found = sample.color if name == COLOR else sample.spectral
            if code in found:
                msg = (
                    f"geometry {code} of {key[0]!r} stands twice, before in row "
                    f"{found[code].number}: remove one of the two rows, or give the "
                    "readings different names"
                )
                raise source.fault(sheet.where(place), msg)
            found[code] = place
    return samples


def _keyed(source: Source, sheet: Sheet) -> Iterator[tuple[Place, Key, str]]:
    if not sheet.rows:
        return
    name, time, geometry = map(sheet.column, ("Name", "Date", "Geometry"))
    for place in sheet.rows:
        cells = place.cells
        yield (
            place,
            (str(cells[name]), _moment(source, sheet, place, time)),
            str(cells[geometry]).strip(),
        )


def _moment(source: Source, sheet: Sheet, place: Place, column: int) -> datetime | None:
    cell = place.cells[column]
    if isinstance(cell, datetime):
        return cell
    if full(cell):
        msg = "not a time: give the column the cell format date and time"
        raise source.fault(sheet.where(place, column), msg, cell)
    return None


def _rows(sample: _Sample, sheets: dict[str, Sheet]) -> list[Row]:
    color, spectral = sheets[COLOR], sheets[SPECTRAL]
    lab_columns = [color.column(w) for w in ("L*", "a*", "b*")] if color.rows else []
    rows = []
    for code in sample.color | sample.spectral:
        lab, factors = sample.color.get(code), sample.spectral.get(code)
        where = spectral.where(factors) if factors else color.where(sample.color[code])
        rows.append(
            Row(
                where,
                _geometry(color, spectral, lab, factors, code),
                color.numbers(lab, lab_columns) if lab else None,
                spectral.numbers(factors, spectral.bands) if factors else None,
            )
        )
    return rows


def _geometry(
    color: Sheet,
    spectral: Sheet,
    lab: Place | None,
    factors: Place | None,
    code: str,
) -> Geometry:
    try:
        return read_geometry(code)
    except InputError as error:
        sheet, place = (spectral, factors) if factors else (color, lab)
        where = sheet.where(place, sheet.column("Geometry")) if place else sheet.name
        raise sheet.source.fault(where, str(error)) from error


def _textures(source: Source, book: Workbook) -> dict[Key, tuple[Texture, ...]]:
    """Named texture values; geometries such as ``15d`` give their angle where known."""
    sheet = Sheet(source, book, TEXTURE)
    found: dict[Key, tuple[Texture, ...]] = {}
    for place, key, code in _keyed(source, sheet):
        for column, heading in enumerate(sheet.heading):
            cell = place.cells[column]
            if heading in {"", "Name", "Date/Time", "Geometry"} or not full(cell):
                continue
            (value,) = sheet.numbers(place, [column])
            name = plain(f"{heading} {code}".strip(), 60)
            found[key] = (*found.get(key, ()), Texture(name, value))
    return found


def _reading(
    source: Source,
    key: Key,
    values: Values,
    textures: tuple[Texture, ...],
    options: Options,
) -> Reading:
    name, moment = key
    try:
        taken_at = to_utc(moment, options.zone) if moment else options.received_at
    except InputError as error:
        raise source.fault(f"reading {name!r}", str(error)) from error
    measurement = Measurement(
        values.geometries,
        values.spectra,
        values.lab,
        texture=textures,
        data_mode=options.data_mode,
        raw=_raw(key, values),
    )
    return Reading(measurement, INSTRUMENT, taken_at, "real", sample=plain(name))


def _raw(key: Key, values: Values) -> bytes:
    """What identifies the reading in whatever workbook it is exported again."""
    codes = "\t".join(geometry.code for geometry in values.geometries)
    text = f"{key[0]}\t{key[1]}\n{codes}\n".encode()
    parts = [text]
    parts += [values.lab.lab.tobytes()] if values.lab else []
    parts += [values.spectra.factors.tobytes()] if values.spectra else []
    return b"".join(parts)
