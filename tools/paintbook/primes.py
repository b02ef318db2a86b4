"""Which candidates become primes: leaf by leaf, by flop index where there is one."""

from __future__ import annotations

import numpy as np

from paintbook.colours import Paints
from paintbook.shelf import Shelf
from paintlink.model import FloatArray

BETWEEN_PRIMES = 2.0
"""Least difference between two primes in one of nine Lab values."""
TOLERANCES = (0.25, 1.0, 4.0, 20.0)
"""How far a flop index may lie from its wish, one round after the other."""
MIDDLE = 11.0


def dealt(
    pool: Paints,
    leaves: list[int],
    flops: FloatArray,
    shelf: Shelf,
    rng: np.random.Generator,
) -> Paints:
    """A paint of the pool for each leaf, in their order.

    Their flop indices lie near the given ones, which meet the leaves at random. The
    tails of the law go first, to whichever leaf can have them.

    Raises
    ------
    RuntimeError
        When the pool has too few paints.
    """
    places = _Places(pool, shelf)
    rows = np.full(len(leaves), -1)
    open_ = [int(slot) for slot in rng.permutation(len(leaves))]
    wishes = sorted(flops.tolist(), key=lambda flop: -abs(flop - MIDDLE))
    for within in TOLERANCES:
        left = []
        for flop in wishes:
            slot, row = _first(places, open_, leaves, flop, within=within)
            if row < 0:
                left.append(flop)
            else:
                rows[slot] = row
                open_.remove(slot)
        wishes = left
    if open_:
        missing = sorted(leaves[slot] for slot in open_)
        msg = f"no candidates for leaves {missing} and flop indices {wishes}: draw more"
        raise RuntimeError(msg)
    return pool.only(rows)


def _first(
    places: _Places, slots: list[int], leaves: list[int], flop: float, *, within: float
) -> tuple[int, int]:
    """The first slot whose leaf has a paint of this flop index, and its row, or -1."""
    for leaf, slot in {leaves[slot]: slot for slot in reversed(slots)}.items():
        row = places.take(leaf, flop, within)
        if row >= 0:
            return slot, row
    return -1, -1


class _Places:
    """Candidates by leaf; those that were taken or have no room any more are gone."""

    def __init__(self, pool: Paints, shelf: Shelf) -> None:
        self._shelf = shelf
        self._travel = pool.travel()
        self._flop = pool.flop
        self._left = {
            leaf: np.flatnonzero(pool.leaf == leaf) for leaf in set(pool.leaf.tolist())
        }

    def take(self, leaf: int, flop: float, within: float) -> int:
        """The row nearest to a flop index that has room, or -1."""
        left = self._left[leaf]
        away = np.abs(self._flop[left] - flop)
        found = -1
        tried = np.zeros(left.size, dtype=np.bool_)
        while found < 0 and not tried.all():
            place = int(np.where(tried, np.inf, away).argmin())
            if away[place] > within:
                break
            tried[place] = True
            row = int(left[place])
            if self._shelf.room(self._travel[row], BETWEEN_PRIMES):
                self._shelf.put(self._travel[row])
                found = row
        self._left[leaf] = left[~tried]
        return found
