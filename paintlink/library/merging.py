"""What becomes of the blocks of a library when paints come, change or go."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import ImportRefusedError, Refusal
from paintlink.library.blocks import Block, changed, joined, numbered, take
from paintlink.library.incoming import MAX_REFUSALS, Incoming
from paintlink.library.rows import Rows

Mode = Literal["add", "update", "replace"]
MODES: tuple[Mode, ...] = get_args(Mode)
Stored = tuple[int, Block]
"""A block and the id it is stored under."""


def merged(
    existing: Iterable[Stored], incoming: Incoming, mode: Mode, next_id: int
) -> Iterator[int | Block]:
    """The blocks of a library after an import; the id alone of one that stays.

    Paints are told by their code: one that is there already keeps its id. `add` takes
    new paints only, `update` new and changed ones, and after `replace` the library
    holds what the import brings and nothing else.

    Raises
    ------
    ImportRefusedError
        When `add` brings a code that is there already.
    """
    pool = _Pool(incoming)
    refusals: list[Refusal] = []
    for block_id, block in existing:
        places = pool.places_of(block.rows)
        found = places >= 0
        if mode == "add":
            refusals += pool.refusals(block.rows, found)
        if len(refusals) >= MAX_REFUSALS:
            break
        if mode == "add" or (mode == "update" and not found.any()):
            yield block_id
        elif found.any():
            yield _updated(block, pool.taken(places[found]), found, mode)
    if refusals:
        raise ImportRefusedError(incoming.source, sorted(refusals, key=_place))
    for rows in pool.left():
        yield numbered(rows, next_id)
        next_id += len(rows)


class _Pool:
    """Incoming paints, looked up by code and taken out once."""

    def __init__(self, incoming: Incoming) -> None:
        self._blocks = incoming.blocks
        self._starts = np.cumsum([0, *map(len, incoming.blocks)])
        self._used = np.zeros(len(incoming), dtype=np.bool_)
        self._index: dict[str, int] | None = None

    def places_of(self, rows: Rows) -> NDArray[np.int64]:
        """Place of each paint's code among the incoming, -1 where it is not there."""
        if self._index is None:
            codes = (code for block in self._blocks for code in block.codes)
            self._index = {code: place for place, code in enumerate(codes)}
        found = (self._index.get(code, -1) for code in rows.codes)
        return np.fromiter(found, np.int64, len(rows))

    def taken(self, places: NDArray[np.int64]) -> Rows:
        """The incoming paints at these places, in this order; no longer left."""
        self._used[places] = True
        block_of = np.searchsorted(self._starts, places, side="right") - 1
        parts = []
        for number in np.unique(block_of):
            (wanted,) = np.nonzero(block_of == number)
            within = places[wanted] - self._starts[number]
            part = take(_unnumbered(self._blocks[number]), within)
            # The wanted order as ids: joining sorts by them.
            parts.append(Block(wanted, part.rows))
        return joined(parts).rows

    def left(self) -> Iterator[Rows]:
        """The incoming paints that were not taken."""
        for rows, start in zip(self._blocks, self._starts, strict=False):
            used = self._used[start : start + len(rows)]
            if not used.any():
                yield rows
            elif not used.all():
                yield take(_unnumbered(rows), np.flatnonzero(~used)).rows

    def refusals(self, rows: Rows, found: NDArray[np.bool_]) -> list[Refusal]:
        """What to say about codes that the library has already."""
        return [
            self._refusal(rows.codes[row])
            for row in np.flatnonzero(found)[:MAX_REFUSALS]
        ]

    def _refusal(self, code: str) -> Refusal:
        index = self._index or {}
        number = int(np.searchsorted(self._starts, index[code], side="right")) - 1
        place = self._blocks[number].places[index[code] - self._starts[number]]
        what = f"the library has the code {code!r} already: import with --update"
        return Refusal(place, what)


def _updated(block: Block, news: Rows, found: NDArray[np.bool_], mode: Mode) -> Block:
    """A block with news for the found paints; the others stay, or go on replace."""
    old = take(block, np.flatnonzero(found))
    parts = [Block(old.ids, changed(old.rows, news))]
    if mode == "update" and not found.all():
        parts.append(take(block, np.flatnonzero(~found)))
    return joined(parts)


def _unnumbered(rows: Rows) -> Block:
    return Block(np.arange(len(rows), dtype=np.int64), rows)


def _place(refusal: Refusal) -> tuple[bool, int | str]:
    return isinstance(refusal.place, str), refusal.place
