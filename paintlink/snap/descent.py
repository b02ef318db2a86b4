"""Finding the nearest paints in a tree without looking at most of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.snap.bounds import PRUNING
from paintlink.snap.boxes import Box
from paintlink.snap.conditions import Comparison
from paintlink.snap.scan import Positions, differences, reach, shortlist, total
from paintlink.snap.tree import Tree

FIRST_GROUPS = 2
GROWTH = 3
BY_ANGLE = (1, 2, 0, 3)

Present = Callable[[NDArray[np.int32]], NDArray[np.integer[Any]]]
"""Positions of rows of the tree; negative for those that may not be returned."""


@dataclass(slots=True)
class Nearest:
    """Paints that may still belong to the nearest ``count``, by their positions."""

    count: int
    limit: float = np.inf
    rows: Positions = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    totals: FloatArray = field(default_factory=lambda: np.empty(0))

    def add(self, rows: NDArray[np.integer[Any]], totals: FloatArray) -> None:
        """Take paints in, drop all that are now too far."""
        totals = np.concatenate([self.totals, totals])
        kept, self.limit = shortlist(totals, self.count)
        self.rows = np.concatenate([self.rows, rows])[kept]
        self.totals = totals[kept]


def descend(
    tree: Tree, comparison: Comparison, found: Nearest, present: Present
) -> int:
    """Add the nearest paints of a tree; how many were compared is returned."""
    pruning = PRUNING[comparison.formula.id]
    target = pruning.coordinates(comparison.target)
    compared = 0

    def _lower(box: Box) -> NDArray[Any]:
        return pruning.lower(target, box, comparison.angles_deg)

    bounds = _lower(tree.upper)
    for groups in _in_order(bounds, FIRST_GROUPS, len(bounds), found):
        low, high = tree.leaves.low[groups], tree.leaves.high[groups]
        inner = _lower(Box(low.transpose(BY_ANGLE), high.transpose(BY_ANGLE))).ravel()
        numbers = (groups[:, np.newaxis] * tree.fan + np.arange(tree.fan)).ravel()
        for near in _in_order(inner, pruning.few_leaves, pruning.most_leaves, found):
            compared += _look(tree, numbers[near], comparison, found, present)
    return compared


def _in_order(
    bounds: NDArray[Any], first: int, most: int, found: Nearest
) -> Iterator[Positions]:
    """Positions by ascending bound, in growing batches, until none can be nearer."""
    (near,) = (bounds <= found.limit).nonzero()
    order = near[np.argsort(bounds[near])]
    ascending = bounds[order]
    start, size = 0, first
    while start < len(order):
        end = int(np.searchsorted(ascending, found.limit, side="right"))
        if start >= end:
            return
        yield order[start : min(start + size, end)]
        start, size = start + size, min(size * GROWTH, most)


def _look(
    tree: Tree,
    leaves: Positions,
    comparison: Comparison,
    found: Nearest,
    present: Present,
) -> int:
    """Compare the paints of some leaves; their number is returned."""
    positions = present(tree.rows[leaves].ravel())
    compared = total(differences(tree.lab(leaves), comparison))
    (near,) = ((positions >= 0) & (compared <= reach(found.limit))).nonzero()
    found.add(positions[near], compared[near])
    return positions.size
