"""CSV files of paints for the tests."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from pathlib import Path

HEADINGS = (
    "code", "name", "finish", "L15", "a15", "b15", "L45", "a45", "b45", "L110", "a110",
    "b110", "gloss", "brand", "year",
)  # fmt: skip
Row = list[str]


def a_row(number: int) -> Row:
    """A paint that differs from that of every other number."""
    rng = random.Random(number)
    lab = [
        f"{round(value, 2) + 0.0:.2f}"
        for lightness in (110.0, 60.0, 20.0)
        for value in (
            lightness + rng.uniform(-10, 10),
            rng.uniform(-30, 30),
            rng.uniform(-30, 30),
        )
    ]
    finish = ("solid", "metallic", "pearl")[number % 3]
    facts = [f"{80 + number % 20}", f"Brand {number % 4}", str(1990 + number % 30)]
    return [f"P{number:05d}", f"Paint {number}", finish, *lab, *facts]


def rows(count: int) -> list[Row]:
    """Some paints."""
    return [a_row(number) for number in range(1, count + 1)]


def write_csv(
    path: Path,
    content: Iterable[Row],
    *,
    headings: Sequence[str] = HEADINGS,
    delimiter: str = ",",
    encoding: str = "utf-8",
) -> Path:
    """A CSV file with these cells, which need no quotes."""
    lines = [delimiter.join(row) for row in [list(headings), *content]]
    path.write_bytes(("\n".join(lines) + "\n").encode(encoding))
    return path


def with_cell(table: list[Row], row: int, heading: str, text: str) -> list[Row]:
    """The same rows with another text in one cell; row 0 is on line 2."""
    changed = [list(one) for one in table]
    changed[row][HEADINGS.index(heading)] = text
    return changed
