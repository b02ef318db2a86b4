"""A library as a CSV table that an import reads back to the last bit."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator

import numpy as np

from paintlink.library.profile import field_of
from paintlink.library.rows import BLOCK_PAINTS
from paintlink.model import PaintTable


def csv_lines(table: PaintTable) -> Iterator[str]:
    """The table in pieces of many lines, the headings first.

    Observer, illuminant and origin stand in every row, so that the paints cannot come
    among others by mistake.
    """
    angles = [field_of(letter, angle) for angle in table.angles_deg for letter in "Lab"]
    headings = ["code", "name", "finish", *angles, "gloss", *table.facets]
    yield _lines([[*headings, "observer", "illuminant", "origin"]])
    for start in range(0, len(table), BLOCK_PAINTS):
        yield _lines(_rows(table, start, min(start + BLOCK_PAINTS, len(table))))


def _rows(table: PaintTable, start: int, end: int) -> Iterator[list[object]]:
    lab = table.lab[start:end].reshape(end - start, -1).tolist()
    origin = "synthetic" if table.synthetic else "real"
    for row in range(start, end):
        yield [
            table.codes[row],
            table.names[row],
            table.finishes[row],
            *lab[row - start],
            _gloss(table, row),
            *(facet.value(row) for facet in table.facets.values()),
            table.observer,
            "D65",
            origin,
        ]


def _gloss(table: PaintTable, row: int) -> object:
    if table.gloss_gu is None or np.isnan(table.gloss_gu[row]):
        return ""
    return float(table.gloss_gu[row])


def _lines(rows: Iterator[list[object]] | list[list[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
