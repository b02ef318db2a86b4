"""Files of sections and ``KEY=value`` lines, with the line of everything."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from paintlink.errors import InputError
from paintlink.intake.source import Source
from paintlink.intake.text import parse_number

LONGEST_LIST = 40_000

_SECTION = re.compile(r"\[\s*([^\]]{1,80}?)\s*\]")
_ENTRY = re.compile(r"\s*([A-Za-z][A-Za-z0-9_ ]{0,60}?)\s*[=,:]\s*(.*?)\s*")


class Entry(NamedTuple):
    """A value and its line, from 1."""

    line: int
    text: str


@dataclass
class Section:
    """One section; of keys that stand twice the first counts."""

    line: int
    name: str
    entries: dict[str, Entry] = field(default_factory=dict)
    bare: list[Entry] = field(default_factory=list)

    def text(self, *keys: str) -> str:
        """The value of the first key that is there and not empty."""
        return next((e.text for e in map(self.entries.get, keys) if e and e.text), "")


def sections(source: Source) -> Iterator[Section]:
    """The sections of a file in their order; lines before the first are left out."""
    section: Section | None = None
    for number, line in enumerate(source.lines(), start=1):
        found = _SECTION.fullmatch(line.strip())
        if found:
            if section is not None:
                yield section
            section = Section(number, found[1].upper())
        elif section is not None and line.strip():
            _add(section, number, line)
    if section is not None:
        yield section


def _add(section: Section, number: int, line: str) -> None:
    entry = _ENTRY.fullmatch(line)
    if entry:
        section.entries.setdefault(entry[1].upper(), Entry(number, entry[2]))
    else:
        section.bare.append(Entry(number, line.strip()))


def number_list(source: Source, entry: Entry) -> list[float]:
    """Numbers separated by commas, semicolons or blanks; a separator may end the list.

    Raises
    ------
    InputError
        When one is none, with its place in the list.
    """
    if len(entry.text) > LONGEST_LIST:
        msg = "far more values than a spectrum has: export again"
        raise source.fault(f"line {entry.line}", msg)
    cells = re.split(r"\s*[,;\t]\s*|\s+", entry.text.strip().rstrip(",;"))
    values = []
    for number, cell in enumerate(cells, start=1):
        try:
            values.append(parse_number(cell).value)
        except InputError as error:
            where = f"line {entry.line}, value {number}"
            raise source.fault(where, str(error), cell) from error
    return values


def whole_number(source: Source, section: Section, key: str, default: int) -> int:
    """A whole number from 0 to 9999 under a key.

    Raises
    ------
    InputError
        When it is none.
    """
    entry = section.entries.get(key)
    if entry is None or not entry.text.strip(","):
        return default
    text = entry.text.strip(",").strip()
    if not (text.isascii() and text.isdecimal() and len(text) < 5):
        msg = f"{key} is no whole number: correct it or export again"
        raise source.fault(f"line {entry.line}", msg, text)
    return int(text)
