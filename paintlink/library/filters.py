"""Narrowing a library: the check boxes, drawers, sliders, facets and search field."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from paintlink.color import LEAVES, Leaf
from paintlink.errors import LibraryError
from paintlink.library.columns import columns
from paintlink.library.facets import FacetChoice
from paintlink.model import Finish, FloatArray, PaintTable

Mask = NDArray[np.bool_]
Range = tuple[float, float]
IndexName = Literal["flop", "hue_shift", "chroma"]
INDEX_NAMES: tuple[IndexName, ...] = get_args(IndexName)


@dataclass(frozen=True, slots=True)
class Filter:
    """Conditions a paint must meet; one that is left empty lets every paint pass.

    Parameters
    ----------
    finishes, leaves
        The paint has one of these finishes, lies in one of these leaves.
    flop, hue_shift, chroma
        Lowest and highest index, both included. A paint whose index is undefined
        passes no range.
    text
        Part of the code or of the name, in any case.
    facets
        Conditions on further columns; the paint meets each of them.
    """

    finishes: tuple[Finish, ...] = ()
    leaves: tuple[Leaf, ...] = ()
    flop: Range | None = None
    hue_shift: Range | None = None
    chroma: Range | None = None
    text: str = ""
    facets: tuple[FacetChoice, ...] = ()

    def apply(self, table: PaintTable) -> Mask:
        """Which paints pass, shape (n,).

        Raises
        ------
        LibraryError
            When none does; names the condition that took the last ones.
        """
        passing = np.ones(len(table), dtype=np.bool_)
        for condition, mask in self._conditions(table):
            before = np.count_nonzero(passing)
            passing &= mask
            if not passing.any():
                msg = (
                    f"{table.library}: none of {before} paints passes the filter "
                    f"{condition}: widen it"
                )
                raise LibraryError(msg)
        return passing

    def mask(self, table: PaintTable) -> Mask:
        """Which paints pass, shape (n,); it may be that none does."""
        passing = np.ones(len(table), dtype=np.bool_)
        for _, mask in self._conditions(table):
            passing &= mask
        return passing

    def without(self, index: IndexName) -> Filter:
        """The same conditions but for the range of one index."""
        empty: dict[str, Range | None] = {index: None}
        return replace(self, **empty)  # type: ignore[arg-type]

    def _conditions(self, table: PaintTable) -> Iterator[tuple[str, Mask]]:
        if self.finishes:
            passing = columns(table).where(*self.finishes)
            yield f"finish {' or '.join(self.finishes)}", passing
        if self.leaves:
            names = " or ".join(
                f"{leaf.paint_set} {leaf.family}" for leaf in self.leaves
            )
            yield f"leaf {names}", _in_leaves(table, self.leaves)
        yield from self._ranges(table)
        for choice in self.facets:
            yield str(choice), choice.mask(table)
        if self.text:
            yield f"text {self.text!r}", _containing(table, self.text.casefold())

    def _ranges(self, table: PaintTable) -> Iterator[tuple[str, Mask]]:
        for name in INDEX_NAMES:
            limits: Range | None = getattr(self, name)
            if limits is not None:
                words = f"{name.replace('_', ' ')} index {limits[0]:g} to {limits[1]:g}"
                yield words, _within(getattr(columns(table), name), limits)


def _within(values: FloatArray, limits: Range) -> Mask:
    passing = values >= limits[0]
    passing &= values <= limits[1]
    return passing


def _in_leaves(table: PaintTable, leaves: tuple[Leaf, ...]) -> Mask:
    # One place more for paints of no leaf, whose index is -1: the last one.
    wanted = np.array([*(leaf in leaves for leaf in LEAVES), False])
    return wanted[columns(table).leaves]


def _containing(table: PaintTable, text: str) -> Mask:
    found = (text in one for one in columns(table).texts)
    return np.fromiter(found, np.bool_, len(table))
