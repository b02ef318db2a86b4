"""Delimited tables of unknown origin."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from paintlink.intake.source import Source

MAX_ROWS = 300_000
MAX_COLUMNS = 4_000
DELIMITERS = (";", "\t", ",", "|")
HEADING_ROWS = 40


class TableRow(NamedTuple):
    """One row and its line, from 1."""

    line: int
    cells: list[str]


def table_rows(source: Source, delimiter: str) -> Iterator[TableRow]:
    """The rows that are not empty.

    Raises
    ------
    InputError
        When the quotes do not match, the table is larger than any export, or it ends
        within a row.
    """
    reader = csv.reader(
        io.StringIO(source.text, newline=""), delimiter=delimiter, strict=True
    )
    before = count = 0
    try:
        for cells in reader:
            if reader.line_num > MAX_ROWS or len(cells) > MAX_COLUMNS:
                msg = (
                    f"more than {MAX_ROWS} rows or {MAX_COLUMNS} columns: split the "
                    "export"
                )
                raise source.fault(f"line {reader.line_num}", msg)
            if any(cell.strip() for cell in cells):
                before, count = count, len(cells)
                yield TableRow(reader.line_num, cells)
    except csv.Error as error:
        msg = f"damaged table ({error}): export it again"
        raise source.fault(f"line {reader.line_num}", msg) from error
    if count < before and not has_last_line_end(source):
        msg = (
            f"the file ends within this row, after {count} of {before} cells: copy it "
        )
        raise source.fault(f"line {reader.line_num}", f"{msg}or export it again")


def has_last_line_end(source: Source) -> bool:
    """Whether the last line is as complete as the others: it ends as they do."""
    return source.text.endswith(("\n", "\r"))


def likely_delimiter(text: str) -> str:
    """The sign that cuts the first lines into equally many cells; empty for none."""
    lines = [line for line in text.splitlines()[:HEADING_ROWS] if line.strip()]
    best, most = "", 0
    for sign in DELIMITERS:
        for cuts, agree in Counter(line.count(sign) for line in lines).items():
            if cuts >= 2 and agree >= 2 and agree * cuts > most:
                best, most = sign, agree * cuts
    return best
