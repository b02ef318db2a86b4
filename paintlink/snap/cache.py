"""Indexes kept between searches, one for each library and set of angles."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock
from weakref import ref

from paintlink.model import PaintTable
from paintlink.snap.conditions import Conditions
from paintlink.snap.index import Index
from paintlink.snap.stock import stock_of

KEPT = 16


class Indexes:
    """The latest index of each library at each set of angles; safe between threads.

    A table is known by its identity: another one of the same library is a later state
    of it, for which the index is renewed.
    """

    def __init__(self) -> None:
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
        index = known[1].renewed(table) if known else _new(table, conditions)
        self.keep(table, index)
        return index

    def keep(self, table: PaintTable, index: Index) -> None:
        """Use this index for the table from now on."""
        with self._lock:
            self._kept[table.library, index.conditions] = (ref(table), index)
            self._kept.move_to_end((table.library, index.conditions))
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)


def _new(table: PaintTable, conditions: Conditions) -> Index:
    return Index(table.library, conditions, stock_of(table, conditions))


INDEXES = Indexes()
"""Of this process."""
