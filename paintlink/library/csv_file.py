"""Reading a table of paints from a CSV file."""

from __future__ import annotations

import codecs
import csv
import os
from collections.abc import Iterator
from io import TextIOWrapper
from itertools import chain, islice
from pathlib import Path
from typing import BinaryIO, cast

from paintlink.errors import ImportRefusedError, LibraryError, Refusal
from paintlink.library.headings import layout
from paintlink.library.incoming import (
    Collector,
    Incoming,
    Places,
    Progress,
    TooManyRefusalsError,
    untold,
)
from paintlink.library.profile import Profile
from paintlink.library.rows import READ_AT_ONCE
from paintlink.library.table_rows import Converter, Row

DELIMITERS = ",;\t|"
AS_THE_FILE_SAYS = Profile()
MAX_UNDECODABLE = 20
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}


def read_csv(
    path: Path, profile: Profile = AS_THE_FILE_SAYS, *, progress: Progress = untold
) -> Incoming:
    """The paints of a CSV file: every row, or none of them.

    Parameters
    ----------
    path
        A table with one heading line; see docs/library.md.

    Raises
    ------
    ImportRefusedError
        When rows are refused; holds their lines and the reasons.
    LibraryError
        When the file cannot be read or its columns are not understood.
    """
    encoding = profile.encoding
    try:
        encoding = encoding or _encoding(path)
        with path.open(encoding=encoding, newline="") as file:
            return _collect(file, path, profile, progress)
    except OSError as error:
        msg = f"{path} cannot be read: {error.strerror}"
        raise LibraryError(msg) from error
    except UnicodeError as error:
        raise _undecodable(path, encoding, error) from error


def _collect(
    file: TextIOWrapper, path: Path, profile: Profile, progress: Progress
) -> Incoming:
    table = _Table(file, path, profile)
    blocks = table.blocks()
    first = next(blocks, ([], range(0)))
    convert = _converter(table, profile, first[0])
    collector = Collector(str(path), convert.conditions)
    try:
        for rows, places in chain([first], blocks):
            collector.add(rows, places, convert)
            progress(table.share)
    except TooManyRefusalsError:
        return collector.finish(stopped=True)
    except csv.Error as error:
        collector.refuse(table.line, f"no CSV from here on, {error}: close the quotes")
        return collector.finish(stopped=True)
    return collector.finish()


def _converter(table: _Table, profile: Profile, rows: list[Row]) -> Converter:
    try:
        return Converter(layout(table.headings, profile), profile, rows)
    except LibraryError as error:
        msg = f"{table.path}: {error}"
        raise LibraryError(msg) from error


class _Table:
    """An open CSV file: its headings, then its rows."""

    def __init__(self, file: TextIOWrapper, path: Path, profile: Profile) -> None:
        self.path = path
        self._bytes = cast("BinaryIO", file.buffer)
        self._size = max(os.fstat(file.fileno()).st_size, 1)
        first = file.readline()
        delimiter = profile.delimiter or _delimiter(first)
        lines = chain([first], file)
        self._reader = csv.reader(lines, delimiter=delimiter, strict=True)
        try:
            self.headings = next(self._reader, [])
        except csv.Error as error:
            msg = f"{path}: line 1 is no heading of a CSV table: {error}"
            raise LibraryError(msg) from error

    @property
    def line(self) -> int:
        """Lines read so far."""
        return self._reader.line_num

    @property
    def share(self) -> float:
        """Share of the file read so far."""
        return min(self._bytes.tell() / self._size, 1.0)

    def blocks(self) -> Iterator[tuple[list[Row], Places]]:
        """Some rows at a time, each with the line it begins on; blank ones left out.

        Raises
        ------
        csv.Error
            After the rows in front of the place that is no CSV.
        """
        while True:
            before, broken = self.line, None
            rows: list[Row] = []
            try:
                rows.extend(islice(self._reader, READ_AT_ONCE))
            except csv.Error as error:
                broken = error
            if rows:
                yield _numbered(rows, before, self.line)
            if broken:
                raise broken
            if not rows:
                return


def _numbered(rows: list[Row], before: int, after: int) -> tuple[list[Row], Places]:
    if after - before == len(rows) and all(rows):
        return rows, range(before + 1, after + 1)
    lines = []
    line = before + 1
    for row in rows:
        lines.append(line)
        line += 1 + sum(map(_breaks, row))
    kept = [(row, line) for row, line in zip(rows, lines, strict=True) if row]
    return [row for row, _ in kept], [line for _, line in kept]


def _breaks(text: str) -> int:
    pairs = text.count("\r\n")
    return text.count("\r") + text.count("\n") - pairs


def _delimiter(headings: str) -> str:
    return max(DELIMITERS, key=headings.count)


def _encoding(path: Path) -> str:
    with path.open("rb") as file:
        start = file.read(4)
    marks = (name for mark, name in _MARKS.items() if start.startswith(mark))
    return next(marks, "utf-8")


def _undecodable(path: Path, encoding: str, error: UnicodeError) -> LibraryError:
    """What to say about a file in another encoding: its lines, where it has any."""
    advice = "say how the file is written, such as --encoding cp1252"
    refusals = []
    with path.open("rb") as file:
        for number, line in enumerate(file, start=1):
            try:
                line.decode(encoding)
            except UnicodeError:
                what = f"not in the encoding {encoding}: {advice}"
                refusals.append(Refusal(number, what))
            if len(refusals) == MAX_UNDECODABLE:
                break
    if encoding.startswith("utf-16") or not refusals:
        return LibraryError(f"{path} is not in the encoding {encoding}: {error}")
    return ImportRefusedError(str(path), refusals, stopped=True)
