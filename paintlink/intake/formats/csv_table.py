"""Tables of other programs, read by a profile that says what each column holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime

from paintlink.errors import InputError
from paintlink.intake.assembly import Scales, assemble
from paintlink.intake.conditions import (
    Conditions,
    Scale,
    read_conditions,
    split_conditions,
)
from paintlink.intake.contract import (
    NO_TIME,
    Certainty,
    Colour,
    Contents,
    ImporterInfo,
    Options,
)
from paintlink.intake.formats._csv_cells import Cells, ReadRow
from paintlink.intake.profile import Profile, heading_key
from paintlink.intake.profile_file import built_in
from paintlink.intake.source import Source
from paintlink.intake.table import (
    HEADING_ROWS,
    TableRow,
    has_last_line_end,
    likely_delimiter,
    table_rows,
)
from paintlink.intake.text import plain
from paintlink.intake.times import parse_time
from paintlink.model import (
    FINISHES,
    Finish,
    Gloss,
    Instrument,
    Measurement,
    Origin,
    Reading,
)

INFO = ImporterInfo("csv_table", "Table (CSV) with a mapping profile")
NO_LAST_LINE_END = (
    "the last line has no end: check that the file is whole, and its last number"
)


def sniff(source: Source) -> Certainty:
    """Perhaps any text whose lines fall into equally many cells."""
    if source.head.startswith(("<", "{", "[")):
        return Certainty.NO
    return Certainty.MAYBE if likely_delimiter(source.head) else Certainty.NO


def read(source: Source, options: Options) -> Contents:
    """One reading for each row, or for each run of rows that are angles of one name."""
    profile, heading, rows = _mapped(source, (*options.profiles, *built_in()))
    cells = Cells(source, profile, heading)
    table = _Table(source, profile, options)
    for group in _groups(profile, map(cells.read, rows)):
        table.add(group)
    notes = [source.decoded.note] if source.decoded.note else []
    if not has_last_line_end(source):
        notes.append(NO_LAST_LINE_END)
    return Contents(tuple(table.colours), notes=(*notes, *cells.notes, *table.notes))


def _mapped(
    source: Source, profiles: Sequence[Profile]
) -> tuple[Profile, TableRow, Iterator[TableRow]]:
    """The first profile that fits a row of headings, that row, and the rows below."""
    for profile in profiles:
        above: list[TableRow] = []
        for row in table_rows(source, profile.delimiter):
            if profile.fits(row.cells):
                return profile, row, _below(source, profile, row)
            above.append(row)
            if len(above) >= HEADING_ROWS:
                break
    msg = (
        "no profile fits the headings of this table: make one with `paintlink import "
        f"FILE --make-profile -o shop.toml`{_nearest(source, profiles)}"
    )
    raise source.fault("", msg)


def _below(source: Source, profile: Profile, heading: TableRow) -> Iterator[TableRow]:
    """The rows below the headings, one after the other: a table may be large."""
    rows = table_rows(source, profile.delimiter)
    return (row for row in rows if row.line > heading.line)


def _nearest(source: Source, profiles: Sequence[Profile]) -> str:
    """What the profile lacks that fits best, when one nearly does."""
    best: tuple[float, str] = (0.5, "")
    for profile in profiles:
        for row in _first_rows(source, profile.delimiter):
            missing = profile.needed - {heading_key(cell) for cell in row.cells}
            share = 1.0 - len(missing) / len(profile.needed)
            if share > best[0]:
                lacking = ", ".join(sorted(missing)[:5])
                best = share, f"; {profile.name!r} lacks in line {row.line}: {lacking}"
    return best[1]


def _first_rows(source: Source, delimiter: str) -> list[TableRow]:
    rows = []
    for row in table_rows(source, delimiter):
        rows.append(row)
        if len(rows) >= HEADING_ROWS:
            break
    return rows


def _groups(profile: Profile, rows: Iterable[ReadRow]) -> Iterator[list[ReadRow]]:
    """Rows of one reading: one, or the angles that follow each other under one name.

    The first angle of a reading, met again, begins the next reading of that name.
    """
    if not profile.is_long:
        for row in rows:
            yield [row]
        return
    group: list[ReadRow] = []
    for row in rows:
        if group and (row.key != group[0].key or row.angle == group[0].angle):
            yield group
            group = []
        group.append(row)
    if group:
        yield group


@dataclass
class _Table:
    """What is collected over the readings of one table."""

    source: Source
    profile: Profile
    options: Options

    def __post_init__(self) -> None:
        self.colours: list[Colour] = []
        self.notes: dict[str, None] = {}

    def add(self, group: list[ReadRow]) -> None:
        """Collect the reading of a group of rows."""
        first = group[0]
        name = plain(first.text("name")) or f"line {first.line}"
        scales = Scales(
            wavelengths_nm=first.wavelengths_nm,
            scale=self._scale(group),
            conditions=self._conditions(first),
        )
        values = assemble(self.source, [r for row in group for r in row.rows], scales)
        self.notes |= {f"{name}: {note}": None for note in values.notes}
        if values.spectra is None and values.lab is None:
            msg = "no values in the row: fill it in or leave it out"
            raise self.source.fault(f"line {first.line}", msg)
        measurement = Measurement(
            values.geometries,
            values.spectra,
            values.lab,
            gloss=self._gloss(first),
            texture=tuple(one for row in group for one in row.texture),
            averaged=self._averaged(first),
            data_mode=plain(first.text("data_mode"))
            or self.options.data_mode
            or self.profile.data_mode,
            raw="\n".join(row.raw for row in group).encode(),
        )
        reading = Reading(
            measurement,
            self._instrument(first),
            self._time(first),
            self._origin(first),
            sample=name,
        )
        self.colours.append(
            Colour(reading, self._finish(first), plain(first.text("code")))
        )

    def _scale(self, group: list[ReadRow]) -> Scale:
        """The profile's, unless every value carries a percent sign of its own."""
        signs = {sign for row in group for sign in row.percent_signs}
        if signs == {True}:
            return "fraction"
        if len(signs) > 1:
            msg = (
                "some reflectance values carry a percent sign and others do not: write "
                "all alike"
            )
            raise self.source.fault(f"line {group[0].line}", msg)
        return self.options.scale or self.profile.scale

    def _conditions(self, row: ReadRow) -> Conditions | None:
        if not any(one.lab for one in row.rows):
            return None
        light, eye = row.text("illuminant"), row.text("observer")
        try:
            if light and eye:
                return read_conditions(light, eye)
            return split_conditions(row.text("conditions") or self.profile.conditions)
        except InputError as error:
            if any(one.factors for one in row.rows):
                self.notes[f"Lab left out: {error}"] = None
                return None
            raise self.source.fault(f"line {row.line}", str(error)) from error

    def _gloss(self, row: ReadRow) -> Gloss | None:
        found = row.gloss
        if found is None:
            return None
        try:
            return Gloss(*found)
        except InputError as error:
            raise self.source.fault(f"line {row.line}", str(error)) from error

    def _averaged(self, row: ReadRow) -> int:
        text = row.text("averaged").strip()
        known = text.isascii() and text.isdecimal() and 1 <= len(text) < 4
        return max(1, int(text)) if known else 1

    def _instrument(self, row: ReadRow) -> Instrument:
        return Instrument(
            plain(row.text("maker"), 60) or self.profile.maker,
            plain(row.text("model"), 60) or self.profile.model,
            plain(row.text("serial"), 60),
        )

    def _origin(self, row: ReadRow) -> Origin:
        return "simulated" if row.text("origin").strip() == "simulated" else "real"

    def _finish(self, row: ReadRow) -> Finish:
        word = row.text("finish").strip().casefold()
        return next((one for one in FINISHES if one == word), "unknown")

    def _time(self, row: ReadRow) -> datetime:
        text = row.text("time") or " ".join(
            filter(None, (row.text("date"), row.text("clock")))
        )
        if not text.strip():
            self.notes[NO_TIME] = None
            return self.options.received_at
        try:
            return parse_time(text, self.options.zone, self.profile.time_format)
        except InputError as error:
            where = f"line {row.line}, time"
            raise self.source.fault(where, str(error), text) from error
