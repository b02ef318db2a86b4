"""What an import brings: paints that were found right, and what was refused."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from paintlink.errors import ImportRefusedError, Refusal
from paintlink.library.rows import (
    BLOCK_PAINTS,
    Conditions,
    RowError,
    Rows,
    check,
    together,
)

MAX_REFUSALS = 1000
"""After so many the file as a whole is wrong, and reading it on tells nothing new."""

FRACTION_LIMIT = 1.0
"""No library of several paints lies below this L* at every angle."""

Piece = TypeVar("Piece")
Progress = Callable[[float], None]
"""Told the share of the work that is done, from 0 to 1."""

Places = Sequence[int | str]
"""Line numbers or file names."""


@dataclass(frozen=True, slots=True, eq=False)
class Incoming:
    """Checked paints of one import, all under the same conditions.

    Parameters
    ----------
    source
        File or folder they were read from.
    blocks
        The paints in the order of the source; no code stands twice.
    """

    source: str
    conditions: Conditions
    blocks: tuple[Rows, ...]

    def __len__(self) -> int:
        return sum(map(len, self.blocks))


def untold(share: float) -> None:
    """Progress that nobody looks at."""


class TooManyRefusalsError(Exception):
    """Reading on would tell nothing new."""


class Collector:
    """Gathers the paints of one import, and what is refused with its place."""

    def __init__(self, source: str, conditions: Conditions) -> None:
        self._source = source
        self._conditions = conditions
        self._blocks: list[Rows] = []
        self._begun: list[Rows] = []
        self._codes: set[str] = set()
        self._refusals: list[Refusal] = []

    def add(
        self,
        pieces: list[Piece],
        places: Places,
        convert: Callable[[list[Piece]], Rows],
    ) -> None:
        """Take the paints of some pieces of the source, such as rows of a table.

        ``convert`` makes rows of pieces and raises `RowError` when one is refused;
        then it is asked again for ever fewer of them, until the refused ones are found.

        Raises
        ------
        TooManyRefusalsError
            When reading on would tell nothing new.
        """
        if not pieces:
            return
        try:
            rows = self._checked(convert(pieces))
        except RowError as error:
            if len(pieces) == 1:
                self.refuse(places[0], str(error))
                return
            half = len(pieces) // 2
            self.add(pieces[:half], places[:half], convert)
            self.add(pieces[half:], places[half:], convert)
        else:
            self._codes.update(rows.codes)
            self._begun.append(replace(rows, places=places))
            if sum(map(len, self._begun)) >= BLOCK_PAINTS:
                self._end_block()

    def refuse(self, place: int | str, what: str) -> None:
        """Note something that is refused.

        Raises
        ------
        TooManyRefusalsError
            When reading on would tell nothing new.
        """
        self._refusals.append(Refusal(place, what))
        if len(self._refusals) >= MAX_REFUSALS:
            raise TooManyRefusalsError

    def finish(self, *, stopped: bool = False) -> Incoming:
        """What was gathered.

        Raises
        ------
        ImportRefusedError
            When anything was refused.
        """
        self._end_block()
        if not self._refusals:
            self._check_all()
        if self._refusals:
            raise ImportRefusedError(self._source, self._refusals, stopped=stopped)
        return Incoming(self._source, self._conditions, tuple(self._blocks))

    def _end_block(self) -> None:
        if self._begun:
            self._blocks.append(together(self._begun))
            self._begun = []

    def _checked(self, rows: Rows) -> Rows:
        check(rows, self._conditions.angles_deg)
        codes = set(rows.codes)
        if len(codes) < len(rows) or not self._codes.isdisjoint(codes):
            msg = f"the code {rows.codes[0]!r} stands already{self._first(rows)}"
            raise RowError(msg)
        return rows

    def _first(self, rows: Rows) -> str:
        if len(rows) > 1:
            return ""
        code = rows.codes[0]
        read = (*self._blocks, *self._begun)
        block = next(block for block in read if code in block.codes)
        place = block.places[block.codes.index(code)]
        where = f"on line {place}" if isinstance(place, int) else f"in {place}"
        return f" {where}: keep one of the two"

    def _check_all(self) -> None:
        if not self._blocks:
            self.refuse(self._source, "it holds no paint")
        elif sum(map(len, self._blocks)) > 1 and self._brightest() <= FRACTION_LIMIT:
            self.refuse(
                self._source,
                f"no L* is above {FRACTION_LIMIT:g}: these are fractions; multiply "
                "L*, a* and b* so that white has L* 100",
            )

    def _brightest(self) -> float:
        return max(float(np.max(block.lab[..., 0])) for block in self._blocks)
