"""Columns of a library that filters need again and again, worked out once."""

from __future__ import annotations

from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from paintlink.color import (
    TRAVEL_ANGLES_DEG,
    chroma_index_array,
    flop_index_array,
    hue_shift_index_array,
    leaf_indices,
)
from paintlink.library.lookup import column
from paintlink.model import FINISHES, Finish, FloatArray, PaintTable

_KNOWN: WeakKeyDictionary[PaintTable, Columns] = WeakKeyDictionary()


def columns(table: PaintTable) -> Columns:
    """The derived columns of a library, kept for as long as the library is."""
    known = _KNOWN.get(table)
    if known is None:
        known = _KNOWN[table] = Columns(table)
    return known


class Columns:
    """Derived columns of one library, each worked out when it is first asked for.

    Indices of colour travel are NaN where they are undefined.
    """

    def __init__(self, table: PaintTable) -> None:
        # No reference to the table: it would keep itself alive in the cache.
        self._library = table.library
        self._angles_deg = table.angles_deg
        self._lab = table.lab
        self._finishes = table.finishes
        self._texts = table.codes, table.names

    @cached_property
    def finishes(self) -> NDArray[np.int8]:
        """Index into `paintlink.model.FINISHES` of every paint."""
        codes = {finish: index for index, finish in enumerate(FINISHES)}
        found = map(codes.__getitem__, self._finishes)
        return np.fromiter(found, np.int8, len(self._finishes))

    @cached_property
    def leaves(self) -> NDArray[np.int8]:
        """Index into `paintlink.color.LEAVES`, -1 for unknown finishes."""
        lab45 = self._lab[:, self._column(45.0)]
        return leaf_indices(lab45, self._finishes).astype(np.int8)

    @cached_property
    def flop(self) -> FloatArray:
        """Flop Index."""
        return _contiguous(flop_index_array(self._travel))

    @cached_property
    def hue_shift(self) -> FloatArray:
        """Hue Shift Index in units of Lab ΔE."""
        return _contiguous(hue_shift_index_array(self._travel))

    @cached_property
    def chroma(self) -> FloatArray:
        """Chroma Index in units of Lab ΔE."""
        return _contiguous(chroma_index_array(self._travel))

    @cached_property
    def texts(self) -> tuple[str, ...]:
        """Code and name of every paint as the search field compares them."""
        pairs = zip(*self._texts, strict=True)
        return tuple(f"{code}\n{name}".casefold() for code, name in pairs)

    def where(self, *finishes: Finish) -> NDArray[np.bool_]:
        """Which paints have one of these finishes, shape (n,)."""
        wanted = np.array([finish in finishes for finish in FINISHES])
        return wanted[self.finishes]

    @property
    def _travel(self) -> FloatArray:
        return self._lab[:, [self._column(angle) for angle in TRAVEL_ANGLES_DEG]]

    def _column(self, angle_deg: float) -> int:
        return column(self._library, self._angles_deg, angle_deg)


def _contiguous(values: FloatArray) -> FloatArray:
    values = np.ascontiguousarray(values)
    values.setflags(write=False)
    return values
