"""Indexes kept between searches, one for each library and set of angles."""

from __future__ import annotations

from collections import OrderedDict
from pathlib import Path
from threading import Lock
from weakref import ref

from paintlink.model import PaintTable
from paintlink.snap.conditions import Conditions
from paintlink.snap.index import Index
from paintlink.snap.stock import stock_of

KEPT = 16


class Indexes:
    """The latest index of each library at each set of angles; safe between threads.

    With a ``folder`` trees outlast the process in files.

    A table is known by its identity: another one of the same library is a later state
    of it, for which the index is renewed.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self._lock = Lock()
        self._kept: OrderedDict[
            tuple[str, Conditions], tuple[ref[PaintTable], Index]
        ] = OrderedDict()

    def of(self, table: PaintTable, conditions: Conditions) -> Index:
        """The index of this table, made or renewed if it has to be."""
        key = (table.library, conditions)
        with self._lock:
            known = self._kept.get(key)
            if known is not None and known[0]() is table:
                self._kept.move_to_end(key)
                return known[1]
        index = known[1].renewed(table) if known else self._new(table, conditions)
        self.keep(table, index)
        return index

    def keep(self, table: PaintTable, index: Index) -> None:
        """Use this index for the table from now on."""
        with self._lock:
            self._kept[table.library, index.conditions] = (ref(table), index)
            self._kept.move_to_end((table.library, index.conditions))
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)

    def _new(self, table: PaintTable, conditions: Conditions) -> Index:
        stock = stock_of(table, conditions)
        return Index(table.library, table.generation, conditions, stock, self.folder)


INDEXES = Indexes()
"""Of this process. Set its ``folder`` to keep trees in files between processes."""
