"""The report an X-Rite MA68 or MA68II prints, saved to a file.

One heading, 31 rows of a wavelength and a (standard, sample) pair of percentages for
each of the five angles, then a colour row for each angle. The pairs are inferred from
one published record; the illuminant of the colour rows is not in the report, so Lab is
computed from the spectra.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

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
from paintlink.intake.ini import Entry
from paintlink.intake.source import Source
from paintlink.intake.text import parse_number, plain
from paintlink.model import Geometry, Instrument, Measurement, Reading

INFO = ImporterInfo("ma68_print", "X-Rite MA68 printed report (text)")

ANGLES_DEG = (15.0, 25.0, 45.0, 75.0, 110.0)
BANDS_NM = tuple(float(band) for band in range(400, 701, 10))
SAMPLE_COLUMNS = {11: (2, 4, 6, 8, 10), 6: (1, 2, 3, 4, 5)}

_BAND_ROW = re.compile(r"\s*([4-7]\d0)((?:\s+\S+){5,20})\s*")
_MODEL = re.compile(r"MA\s?-?(68II|68)", re.IGNORECASE)
_ANGLE_ROW = re.compile(r"\s*(?:15|25|45|75|110)\s")


def sniff(source: Source) -> Certainty:
    """Sure of a text with many rows that begin with a wavelength."""
    rows = sum(1 for line in source.head.splitlines() if _BAND_ROW.fullmatch(line))
    return Certainty.SURE if rows >= 5 else Certainty.NO


@dataclass
class _Report:
    """Lines of one report."""

    heading: list[str] = field(default_factory=list)
    bands: list[Entry] = field(default_factory=list)


def read(source: Source, options: Options) -> Contents:
    """One reading for each report in the file."""
    reports = _reports(source.lines())
    if not reports:
        raise source.fault("", "no rows of wavelengths in it: save the report again")
    notes = [NO_TIME]
    notes += [source.decoded.note] if source.decoded.note else []
    colours = [_colour(source, report, options, notes) for report in reports]
    return Contents(tuple(colours), notes=tuple(notes))


def _reports(lines: list[str]) -> list[_Report]:
    reports: list[_Report] = []
    heading: list[str] = []
    for number, line in enumerate(lines, start=1):
        if _BAND_ROW.fullmatch(line):
            if line.split()[0] == "400" or not reports:
                reports.append(_Report(heading))
                heading = []
            reports[-1].bands.append(Entry(number, line))
        elif not _ANGLE_ROW.match(line) and line.strip():
            heading.append(line.strip())
    return reports


def _colour(
    source: Source, report: _Report, options: Options, notes: list[str]
) -> Colour:
    columns = _columns(source, report)
    _require_all_bands(source, report)
    decimal = "." if any("." in row.text for row in report.bands) else ","
    table = [_numbers(source, row, columns, decimal) for row in report.bands]
    first, last = report.bands[0].line, report.bands[-1].line
    rows = [
        Row(
            f"lines {first} to {last}",
            Geometry(angle, code=f"{angle:g}"),
            factors=[numbers[index] for numbers in table],
        )
        for index, angle in enumerate(ANGLES_DEG)
    ]
    scales = Scales(wavelengths_nm=BANDS_NM, scale=options.scale or "percent")
    values = assemble(source, rows, scales)
    measurement = Measurement(
        values.geometries,
        values.spectra,
        data_mode=options.data_mode,
        raw="\n".join([*report.heading, *(row.text for row in report.bands)]).encode(),
    )
    model = _MODEL.search(" ".join(report.heading))
    instrument = Instrument("X-Rite", f"MA{model[1].upper()}" if model else "MA68")
    name = plain(report.heading[-1]) if report.heading else f"report in line {first}"
    notes += [f"{name}: {note}" for note in values.notes]
    reading = Reading(measurement, instrument, options.received_at, "real", sample=name)
    return Colour(reading)


def _columns(source: Source, report: _Report) -> tuple[int, ...]:
    counts = {len(row.text.split()) for row in report.bands}
    if len(counts) == 1 and counts <= SAMPLE_COLUMNS.keys():
        return SAMPLE_COLUMNS[counts.pop()]
    wrong = next(
        row for row in report.bands if len(row.text.split()) not in SAMPLE_COLUMNS
    ) if counts - SAMPLE_COLUMNS.keys() else report.bands[-1]  # fmt: skip
    msg = (
        f"{len(wrong.text.split())} numbers in the row: expected a wavelength and five "
        "pairs of standard and sample, or five samples, in every row; print it again"
    )
    raise source.fault(f"line {wrong.line}", msg)


def _require_all_bands(source: Source, report: _Report) -> None:
    wanted = [f"{band:.0f}" for band in BANDS_NM]
    for row, band in zip(report.bands, wanted, strict=False):
        if row.text.split()[0] != band:
            msg = f"expected the row of {band} nm: print the report again"
            raise source.fault(f"line {row.line}", msg, row.text.split()[0])
    if len(report.bands) != len(wanted):
        row = report.bands[-1]
        msg = (
            f"{len(report.bands)} rows of wavelengths, expected 31 from 400 to 700 nm: "
            "the report is cut or doubled, print it again"
        )
        raise source.fault(f"line {row.line}", msg)


def _numbers(
    source: Source, row: Entry, columns: tuple[int, ...], decimal: str
) -> list[float]:
    cells = row.text.split()
    values = []
    for column in columns:
        try:
            values.append(parse_number(cells[column], decimal=decimal).value)
        except InputError as error:
            where = f"line {row.line}, column {column + 1}"
            raise source.fault(where, str(error), cells[column]) from error
    return values
