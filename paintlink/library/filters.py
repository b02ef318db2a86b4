"""Narrowing a library: the check boxes, drawers, sliders and search field."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.color import LEAVES, Leaf
from paintlink.errors import LibraryError
from paintlink.library.measures import indices, leaves
from paintlink.model import Finish, FloatArray, PaintTable

Mask = NDArray[np.bool_]
Range = tuple[float, float]


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
    """

    finishes: tuple[Finish, ...] = ()
    leaves: tuple[Leaf, ...] = ()
    flop: Range | None = None
    hue_shift: Range | None = None
    chroma: Range | None = None
    text: str = ""

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

    def _conditions(self, table: PaintTable) -> Iterator[tuple[str, Mask]]:
        if self.finishes:
            yield (
                f"finish {' or '.join(self.finishes)}",
                np.isin(table.finishes, self.finishes),
            )
        if self.leaves:
            names = " or ".join(
                f"{leaf.paint_set} {leaf.family}" for leaf in self.leaves
            )
            drawers = [LEAVES.index(leaf) for leaf in self.leaves]
            yield f"leaf {names}", np.isin(leaves(table), drawers)
        yield from self._ranges(table)
        if self.text:
            yield f"text {self.text!r}", _containing(table, self.text.casefold())

    def _ranges(self, table: PaintTable) -> Iterator[tuple[str, Mask]]:
        if self.flop or self.hue_shift or self.chroma:
            known = indices(table)
            for name, values, limits in (
                ("flop index", known.flop, self.flop),
                ("hue shift index", known.hue_shift, self.hue_shift),
                ("chroma index", known.chroma, self.chroma),
            ):
                if limits:
                    yield (
                        f"{name} {limits[0]:g} to {limits[1]:g}",
                        _within(values, limits),
                    )


def _within(values: FloatArray, limits: Range) -> Mask:
    return (values >= limits[0]) & (values <= limits[1])


def _containing(table: PaintTable, text: str) -> Mask:
    paints = zip(table.codes, table.names, strict=True)
    return np.array([
        text in code.casefold() or text in name.casefold() for code, name in paints
    ])
