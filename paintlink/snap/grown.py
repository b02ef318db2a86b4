"""A tree that is never changed, in a library that is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.snap.stock import Stock
from paintlink.snap.tree import ABSENT, Tree

Positions = NDArray[np.integer]
Mask = NDArray[np.bool_]

DELTA_SHARE = 0.02
DELTA_PAINTS = 4096
"""Changes a tree is used with before it is built anew: the smaller of the two."""


@dataclass(frozen=True, slots=True, eq=False)
class Grown:
    """A tree, and what has changed in the library since it was built.

    Parameters
    ----------
    now
        Position in the present stock of each paint of the tree, `ABSENT` where it was
        removed or changed, with one more `ABSENT` at the end; None where all are
        where they were.
    added
        Positions in the present stock of paints that the tree does not have.
    """

    tree: Tree
    now: NDArray[np.int64] | None
    added: NDArray[np.int64]

    def present(self, rows: Positions, allowed: Mask | None) -> Positions:
        """Positions in the present stock of rows of the tree, or `ABSENT`."""
        positions = rows if self.now is None else self.now[rows]
        if allowed is None:
            return positions
        return np.where((positions >= 0) & allowed[positions], positions, ABSENT)

    def later(self, allowed: Mask | None) -> NDArray[np.int64]:
        """Positions that the tree does not have and that may be returned."""
        return self.added if allowed is None else self.added[allowed[self.added]]


def whole(tree: Tree) -> Grown:
    """A tree over everything there is."""
    return Grown(tree, None, np.empty(0, dtype=np.int64))


def follow(grown: Grown, was: Stock, stock: Stock) -> Grown | None:
    """The same tree in a later stock; None where too much has changed."""
    moved = _moved(was, stock)
    now = moved if grown.now is None else moved[grown.now]
    present = np.zeros(len(stock), dtype=np.bool_)
    present[now[now >= 0]] = True
    added = np.flatnonzero(~present)
    gone = int(np.count_nonzero(now < 0)) - 1
    if max(added.size, gone) > min(DELTA_SHARE * len(stock), DELTA_PAINTS):
        return None
    return Grown(grown.tree, now, added)


def _moved(was: Stock, stock: Stock) -> NDArray[np.int64]:
    """New position of each paint that is still the same, else `ABSENT`."""
    order = np.argsort(stock.ids, kind="stable")
    at = np.searchsorted(stock.ids, was.ids, sorter=order)
    candidate = order[np.minimum(at, len(order) - 1)]
    same = stock.ids[candidate] == was.ids
    for old, new in zip(
        was.planes.reshape(-1, len(was)),
        stock.planes.reshape(-1, len(stock)),
        strict=True,
    ):
        same &= old == new[candidate]
    return np.append(np.where(same, candidate, ABSENT), ABSENT)
