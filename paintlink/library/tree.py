"""The tree a library is browsed by, with the number of paints in every branch."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.color import FAMILIES, LEAVES, NO_LEAF, Leaf
from paintlink.library.columns import columns
from paintlink.model import PaintTable

SETS = {"solid": "solids", "effect": "metallics and pearls"}
BRANCHES = {"chromatic": FAMILIES[:4], "neutral": FAMILIES[4:]}


@dataclass(frozen=True, slots=True)
class TreeCounts:
    """Numbers of paints in each leaf, and of those whose finish is unknown."""

    by_leaf: dict[Leaf, int]
    no_leaf: int

    @property
    def paints(self) -> int:
        """All of them."""
        return sum(self.by_leaf.values()) + self.no_leaf

    def lines(self) -> Iterator[tuple[int, str, int]]:
        """Every branch with its depth from 1, its name and its paints."""
        for paint_set, name in SETS.items():
            yield 1, name, self._sum(paint_set, FAMILIES)
            for branch, families in BRANCHES.items():
                yield 2, branch, self._sum(paint_set, families)
                for family in families:
                    yield 3, family, self._sum(paint_set, (family,))
        if self.no_leaf:
            yield 1, "finish unknown", self.no_leaf

    def document(self) -> dict[str, Any]:
        """The same as nested JSON."""
        sets = {
            paint_set: {
                branch: {one: self._sum(paint_set, (one,)) for one in families}
                for branch, families in BRANCHES.items()
            }
            for paint_set in SETS
        }
        return {"paints": self.paints, **sets, "unknown": self.no_leaf}

    def _sum(self, paint_set: str, families: tuple[str, ...]) -> int:
        return sum(
            count
            for leaf, count in self.by_leaf.items()
            if leaf.paint_set == paint_set and leaf.family in families
        )


def counts(table: PaintTable, mask: NDArray[np.bool_]) -> TreeCounts:
    """Numbers of the paints that pass a filter, see `Filter.mask`."""
    # Leaves count from 1 so that paints of no leaf are counted too.
    found = np.bincount(
        columns(table).leaves[mask] - NO_LEAF, minlength=len(LEAVES) + 1
    )
    by_leaf = zip(LEAVES, found[1:].tolist(), strict=True)
    return TreeCounts(dict(by_leaf), int(found[0]))
