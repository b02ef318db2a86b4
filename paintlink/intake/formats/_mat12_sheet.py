"""One sheet of a workbook: a heading row that names Geometry, and rows below."""

from __future__ import annotations

from typing import NamedTuple

from paintlink.errors import InputError
from paintlink.intake.source import Source
from paintlink.intake.text import parse_number
from paintlink.intake.workbook import Cell, Workbook

HEADING_ROWS = 20


class Place(NamedTuple):
    """A row of one sheet."""

    number: int
    cells: list[Cell]


class Sheet:
    """A sheet below its heading row; empty when it is missing or only a heading."""

    def __init__(self, source: Source, book: Workbook, name: str) -> None:
        self.name = name
        self.source = source
        self.above: list[list[Cell]] = []
        self.heading: list[str] = []
        self.rows: list[Place] = []
        self.wavelengths_nm: tuple[float, ...] = ()
        if name in book.names:
            self._split(book.rows(name))

    def _split(self, rows: list[list[Cell]]) -> None:
        for index, cells in enumerate(rows[:HEADING_ROWS]):
            words = [str(cell).strip() for cell in cells]
            if "Geometry" in words:
                self.above, self.heading = rows[:index], words
                below = enumerate(rows[index + 1 :], start=index + 2)
                self.rows = [Place(n, row) for n, row in below if any(map(full, row))]
                break
        else:
            if any(any(map(full, row)) for row in rows):
                msg = "no heading row with the word Geometry: export it again"
                raise self.source.fault(f"sheet {self.name!r}", msg)
        self._band_columns()

    def _band_columns(self) -> None:
        bands = [(i, word) for i, word in enumerate(self.heading) if _is_band(word)]
        self.bands = [index for index, _ in bands]
        self.wavelengths_nm = tuple(float(word.removesuffix("nm")) for _, word in bands)

    def column(self, word: str) -> int:
        """Number of the column whose heading begins with a word, from 0."""
        for index, heading in enumerate(self.heading):
            if heading.casefold().startswith(word.casefold()):
                return index
        msg = f"no column {word!r}: export it again"
        raise self.source.fault(f"sheet {self.name!r}", msg)

    def where(self, place: Place, column: int | None = None) -> str:
        """The place of a row or a cell, as the spreadsheet program calls it."""
        if column is None:
            return f"sheet {self.name!r}, row {place.number}"
        return f"sheet {self.name!r}, cell {_letters(column)}{place.number}"

    def numbers(self, place: Place, columns: list[int]) -> list[float]:
        """Numbers in some cells of a row."""
        cells = place.cells
        found = [cells[i] for i in columns]
        if set(map(type, found)) == {float}:
            return found  # type: ignore[return-value]
        return [self._number(place, i) for i in columns]

    def _number(self, place: Place, column: int) -> float:
        cell = place.cells[column]
        if isinstance(cell, int | float) and not isinstance(cell, bool):
            return float(cell)
        try:
            if isinstance(cell, str):
                return parse_number(cell).value
            msg = "not a number: correct it or export again"
            raise InputError(msg)
        except InputError as error:
            raise self.source.fault(
                self.where(place, column), str(error), cell
            ) from error


def full(cell: Cell) -> bool:
    return cell not in {"", None}


def _is_band(word: str) -> bool:
    return word.removesuffix("nm").strip().isdecimal() and len(word) <= 6


def _letters(column: int) -> str:
    letters = ""
    number = column + 1
    while number:
        number, rest = divmod(number - 1, 26)
        letters = chr(65 + rest) + letters
    return letters
