"""A profile proposed from the headings and first rows of a table.

What the headings do not say is assumed and marked, for a person to check: nothing is
imported by a guess.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import datetime

from paintlink.errors import InputError
from paintlink.intake.headings import Dialect, meaning_of
from paintlink.intake.profile_file import FORMAT
from paintlink.intake.source import Source
from paintlink.intake.table import HEADING_ROWS, TableRow, likely_delimiter, table_rows
from paintlink.intake.text import parse_number

ROWS_EXAMINED = 60
TIME_FORMATS = (
    "", "%d.%m.%Y %H:%M:%S", "%d.%m.%Y %H:%M", "%d.%m.%Y", "%m/%d/%Y %H:%M:%S",
    "%m/%d/%Y %H:%M", "%m/%d/%Y %I:%M:%S %p", "%m/%d/%Y %I:%M %p", "%m/%d/%Y",
    "%d/%m/%Y %H:%M:%S", "%d/%m/%Y %H:%M", "%d/%m/%Y", "%Y/%m/%d %H:%M:%S",
    "%Y/%m/%d %H:%M", "%d-%m-%Y %H:%M:%S", "%d-%m-%Y %H:%M",
)  # fmt: skip

_WORDS = {",": "comma", ";": "semicolon", "\t": "tab", "|": "pipe", ".": "point"}


@dataclass(frozen=True, slots=True)
class Proposal:
    """The text of a profile, and what in it a person has to check."""

    text: str
    doubts: tuple[str, ...]


@dataclass
class _Draft:
    """The table as it is understood so far."""

    heading: TableRow
    rows: list[TableRow]
    delimiter: str
    meanings: list[str]
    doubts: list[str] = field(default_factory=list)

    def column(self, *wanted: str) -> list[str]:
        """Cells of the first column of a meaning."""
        for index, meaning in enumerate(self.meanings):
            if meaning in wanted:
                return self.cells(index)
        return []

    def cells(self, index: int) -> list[str]:
        """Cells of a column that are not empty."""
        found = [
            row.cells[index].strip() for row in self.rows if index < len(row.cells)
        ]
        return [cell for cell in found if cell]


def propose(source: Source) -> Proposal:
    """A profile for a table.

    Raises
    ------
    InputError
        When the file is no table, or no heading says what a column holds.
    """
    draft = _draft(source)
    decimal = _decimal(draft)
    parts = [
        "# How paintlink reads this table. Check what is marked, then import with",
        "# `paintlink import FILE --profile THIS`, or put it into the folder profiles/",
        "# beside the configuration file, where the inbox finds it too.",
        f"format = {FORMAT}",
        f"name = {_quoted(_stem(source.name))}",
        f"delimiter = {_quoted(_WORDS[draft.delimiter])}",
        f"decimal = {_quoted(_WORDS[decimal])}",
        *_scale(draft, decimal),
        *_conditions(draft),
        *_time_format(draft),
        'maker = "unknown"',
        'model = "unknown"',
        "",
        "[columns]",
        *_column_lines(draft),
    ]
    return Proposal("\n".join(parts) + "\n", tuple(draft.doubts))


def _draft(source: Source) -> _Draft:
    delimiter = likely_delimiter(source.text)
    if not delimiter:
        msg = "no table: its lines do not fall into equally many cells; export as CSV"
        raise source.fault("", msg)
    rows = []
    for row in table_rows(source, delimiter):
        rows.append(row)
        if len(rows) >= HEADING_ROWS + ROWS_EXAMINED:
            break
    best, most = -1, 0
    for index, row in enumerate(rows[:HEADING_ROWS]):
        meanings = _meanings(row.cells)
        known = sum(1 for one in meanings if one not in {"", "ignore"})
        if known > most:
            best, most = index, known
    if most < 3:
        msg = (
            "no row of headings found that names a sample and values such as L* 15 or "
            "400 nm: write a profile by hand as docs/import.md shows"
        )
        raise source.fault("", msg)
    heading = rows[best]
    meanings = _meanings(heading.cells)
    return _Draft(heading, rows[best + 1 :][:ROWS_EXAMINED], delimiter, meanings)


def _meanings(headings: Sequence[str]) -> list[str]:
    dialect = Dialect.of(headings)
    return [meaning_of(heading, dialect) for heading in headings]


def _is_value(meaning: str) -> bool:
    return meaning.split(" ")[-1] in {"L", "a", "b"} or _is_factor(meaning)


def _is_factor(meaning: str) -> bool:
    last = meaning.split(" ")[-1]
    return last[:1] == "R" and last[1:].isdecimal()


def _decimal(draft: _Draft) -> str:
    cells = [
        cell
        for index, meaning in enumerate(draft.meanings)
        if _is_value(meaning)
        for cell in draft.cells(index)
    ]
    commas = sum(1 for cell in cells if "," in cell)
    points = sum(1 for cell in cells if "." in cell)
    if commas and points:
        draft.doubts.append("some numbers have a decimal comma, some a point")
    return "," if commas > points else "."


def _scale(draft: _Draft, decimal: str) -> list[str]:
    values = []
    for index, meaning in enumerate(draft.meanings):
        if not _is_factor(meaning):
            continue
        for cell in draft.cells(index):
            try:
                values.append(parse_number(cell, decimal=decimal).value)
            except InputError:
                draft.doubts.append(f"{cell!r} in a column of reflectance is no number")
                break
    if not values:
        return []
    scale = "percent" if max(values) > 3.0 else "fraction"
    draft.doubts.append(f"scale: reflectance reaches {max(values):g}, taken as {scale}")
    return [f'scale = "{scale}"  # check: the largest value is {max(values):g}']


def _conditions(draft: _Draft) -> list[str]:
    has_lab = any(_is_value(one) and not _is_factor(one) for one in draft.meanings)
    told = {"conditions", "illuminant", "observer"} & {*draft.meanings}
    if not has_lab or told:
        return []
    for heading in draft.heading.cells:
        for word in ("D65/10", "D50/2", "D65/2", "A/10"):
            if word in heading.replace(" ", "").replace("°", ""):
                return [f'conditions = "{word}"']
    draft.doubts.append("conditions: the headings do not say that Lab is for D65/10")
    return ['conditions = "D65/10"  # check: assumed, the headings do not say']


def _time_format(draft: _Draft) -> list[str]:
    dates, clocks = draft.column("date"), draft.column("clock")
    cells = draft.column("time") or [
        " ".join(two) for two in zip(dates, clocks, strict=False)
    ]
    cells = cells or dates
    if not cells:
        return []
    fitting = [pattern for pattern in TIME_FORMATS if all(map(_fits(pattern), cells))]
    if not fitting:
        draft.doubts.append(f"time_format: no known form of time in {cells[0]!r}")
        return ['time_format = ""  # check: write a strptime pattern']
    if len(fitting) > 1:
        draft.doubts.append("time_format: day and month may be the other way round")
        return [
            f"time_format = {_quoted(fitting[0])}  # check: or {_quoted(fitting[1])}"
        ]
    return [f"time_format = {_quoted(fitting[0])}"] if fitting[0] else []


def _fits(pattern: str) -> Callable[[str], bool]:
    def fits(cell: str) -> bool:
        try:
            if pattern:
                datetime.strptime(cell, pattern)  # noqa: DTZ007 - only its form counts
            else:
                datetime.fromisoformat(cell)
        except ValueError:
            return False
        return True

    return fits


def _column_lines(draft: _Draft) -> list[str]:
    lines = []
    seen: set[str] = set()
    used: set[str] = set()
    for heading, meaning in zip(draft.heading.cells, draft.meanings, strict=True):
        name = " ".join(heading.split())
        if not name or name in seen:
            continue
        seen.add(name)
        note = ""
        if meaning in used and meaning not in {"ignore", ""}:
            meaning, note = "ignore", "  # check: another column means the same"
        elif not meaning:
            meaning, note = "ignore", "  # check: not understood"
            draft.doubts.append(f"column {name!r} is not understood and ignored")
        used.add(meaning)
        lines.append(f"{_quoted(name)} = {_quoted(meaning)}{note}")
    if "name" not in used:
        draft.doubts.append("no column is the name: map one")
    return lines


def _stem(name: str) -> str:
    stem = name.replace("\\", "/").rsplit("/", 1)[-1].rsplit(".", 1)[0]
    return "".join(c for c in stem if c.isprintable())[:60] or "table"


def _quoted(text: str) -> str:
    """A TOML string."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
