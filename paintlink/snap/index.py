"""The searchable form of one library at one set of angles, kept up to date."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from paintlink.color import Formula
from paintlink.model import PaintTable
from paintlink.snap import descent
from paintlink.snap.bounds import PRUNING
from paintlink.snap.conditions import Comparison, Conditions
from paintlink.snap.descent import Nearest
from paintlink.snap.grown import Grown, Mask, follow, whole
from paintlink.snap.scan import Ranked, rank, shortlist, totals
from paintlink.snap.stock import Stock, stock_of
from paintlink.snap.tree import Tree, build

FIRST_QUESTION = 2
"""Searches of one answer: it ranks by two formulas."""


@dataclass(slots=True, eq=False, weakref_slot=True)
class Index:
    """A library at some angles.

    With a ``folder`` trees are kept in files there, from which the next process reads
    them; a file that is stale or damaged is written anew.

    Searches may run at the same time in several threads; nothing they read changes.
    """

    library: str
    generation: str
    conditions: Conditions
    stock: Stock
    folder: Path | None = None
    trees: dict[str, Grown] = field(default_factory=dict)
    searches: int = 0

    def nearest(
        self, comparison: Comparison, count: int, allowed: Mask | None = None
    ) -> Ranked:
        """The ``count`` nearest paints in order, by their position in the stock.

        Parameters
        ----------
        allowed
            Paints of the stock that may be returned.
        """
        candidates = len(self.stock)
        if allowed is not None:
            candidates = int(np.count_nonzero(allowed))
        self.searches += 1
        if self._quicker_to_scan(candidates, comparison.formula):
            return self.scan(comparison, count, allowed)
        return self.descend(comparison, count, allowed)

    def allowed(self, mask: Mask | None) -> Mask | None:
        """Which paints of the stock a filter of the table lets pass."""
        if mask is None or len(mask) == len(self.stock):
            return mask
        return mask[self.stock.rows]

    def grown(self, formula: Formula) -> Grown:
        """The tree for a formula, built when it is first asked for."""
        space = space_of(formula)
        if space not in self.trees:
            self.trees[space] = whole(self._tree(formula))
        return self.trees[space]

    def _tree(self, formula: Formula) -> Tree:
        if self.folder is None:
            return tree_of(self.stock, formula)
        # Only a process that keeps trees in files pays for what that needs.
        from paintlink.snap.file import Key, content_of, kept_tree

        content = content_of(self.stock)
        space = space_of(formula)
        key = Key(self.library, self.generation, self.conditions, space, content)
        return kept_tree(self.folder, key, partial(tree_of, self.stock, formula))

    def renewed(self, table: PaintTable) -> Index:
        """The index of a later state of the library, with its trees where they do."""
        stock = stock_of(table, self.conditions)
        followed = {
            space: follow(grown, self.stock, stock)
            for space, grown in list(self.trees.items())
        }
        trees = {space: grown for space, grown in followed.items() if grown is not None}
        return Index(
            table.library,
            table.generation,
            self.conditions,
            stock,
            self.folder,
            trees,
            self.searches,
        )

    def _quicker_to_scan(self, candidates: int, formula: Formula) -> bool:
        """Few paints, or a first question: a tree costs more than a scan or two."""
        if candidates <= PRUNING[formula.id].scan_up_to:
            return True
        return self.searches <= FIRST_QUESTION and space_of(formula) not in self.trees

    def scan(self, comparison: Comparison, count: int, allowed: Mask | None) -> Ranked:
        """As `nearest`, by comparing every paint."""
        planes = self.stock.planes
        chosen = None if allowed is None else np.flatnonzero(allowed)
        if chosen is not None:
            planes = planes[..., chosen]
        near, _ = shortlist(totals(planes, comparison), count)
        positions = near if chosen is None else chosen[near]
        return self._ranked(comparison, count, positions, planes.shape[2])

    def descend(
        self, comparison: Comparison, count: int, allowed: Mask | None
    ) -> Ranked:
        """As `nearest`, by the tree."""
        grown = self.grown(comparison.formula)
        found = Nearest(count)
        later = grown.later(allowed)
        if later.size:
            found.add(later, totals(self.stock.planes[..., later], comparison))
        present = partial(grown.present, allowed=allowed)
        compared = descent.descend(grown.tree, comparison, found, present)
        return self._ranked(comparison, count, found.rows, compared + later.size)

    def _ranked(
        self,
        comparison: Comparison,
        count: int,
        positions: NDArray[np.int64],
        compared: int,
    ) -> Ranked:
        paints, ids = self.stock.planes[..., positions], self.stock.ids[positions]
        order, summed, at_angles = rank(paints, ids, comparison, count)
        return Ranked(positions[order], summed, at_angles, compared)


def space_of(formula: Formula) -> str:
    """Which tree serves a formula: the one over Lab, or one of its own."""
    return "lab" if PRUNING[formula.id].to_space is None else formula.id


def tree_of(stock: Stock, formula: Formula) -> Tree:
    """A tree over everything in the stock, in the coordinates of the formula."""
    lab = np.moveaxis(stock.planes, 1, 2)
    coordinates = PRUNING[formula.id].coordinates(lab)
    return build(stock.planes, np.moveaxis(coordinates, 2, 1))
