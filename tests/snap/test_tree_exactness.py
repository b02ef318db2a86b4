"""The tree against the brute force: the same paints and the same bits."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import Generator

from paintlink.color import FORMULAS
from paintlink.model import FloatArray, PaintTable
from paintlink.snap.conditions import Comparison, Conditions
from paintlink.snap.index import Index
from paintlink.snap.scan import Ranked
from paintlink.snap.stock import stock_of
from tests.snap.conftest import SIX, STANDARD, make_table
from tests.snap.oracle import Mask, brute_order, brute_totals, paints, targets

FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
TOPS = (1, 10, 50)
PAINTS = 700
TABLE_SERVES = 40


def compare(formula: str, seed: int, comparisons: int) -> int:
    """Hold the tree against the brute force; the lists with ties are counted."""
    rng = np.random.default_rng([seed, *formula.encode()])
    done = ties = 0
    while done < comparisons:
        angles = (STANDARD, FIVE, SIX)[rng.integers(3)]
        table = a_library(rng, angles)
        index = Index(
            table.library,
            table.generation,
            Conditions(angles),
            stock_of(table, Conditions(angles)),
        )
        for _ in range(TABLE_SERVES):
            for mask in (None, some_mask(rng, len(table))):
                ties += check(rng, index, table, formula, mask)
                done += len(TOPS)
            table, index = changed(rng, table, index)
    return ties


def a_library(rng: Generator, angles: tuple[float, ...]) -> PaintTable:
    ids = rng.permutation(np.cumsum(rng.integers(1, 4, PAINTS)))
    lab = paints(rng, PAINTS, len(angles))
    return make_table(lab, ids=ids.tolist(), angles_deg=angles)


def some_mask(rng: Generator, count: int) -> Mask:
    return rng.random(count) < rng.choice([0.02, 0.3, 0.9])


def check(
    rng: Generator, index: Index, table: PaintTable, formula: str, mask: Mask | None
) -> bool:
    target = targets(rng, table.lab)
    comparison = Comparison(target, table.angles_deg, FORMULAS[formula])
    total = brute_totals(formula, table.lab, target, table.angles_deg)
    expected = brute_order(total, table.ids)
    if mask is not None:
        expected = expected[mask[expected]]
    for top in TOPS:
        found = index.descend(comparison, top, mask)
        same_list(found, expected[:top], total)
    same_list(index.scan(comparison, 10, mask), expected[:10], total)
    first = total[expected[:50]]
    return len(np.unique(first)) < len(first)


def same_list(found: Ranked, expected: FloatArray, total: FloatArray) -> None:
    assert found.positions.tolist() == expected.tolist()
    assert found.totals.tobytes() == total[expected].tobytes()


def changed(
    rng: Generator, table: PaintTable, index: Index
) -> tuple[PaintTable, Index]:
    """The library after a few paints came, went and changed; its index renewed."""
    kept = np.flatnonzero(rng.random(len(table)) > 0.002)
    lab, ids = table.lab[kept], table.ids[kept]
    corrected = rng.integers(0, len(kept), 2)
    lab[corrected] = np.round(lab[corrected] + 0.5, 2)
    new = int(rng.integers(0, 4))
    lab = np.concatenate([lab, lab[:new] + 0.01, lab[:new]])
    ids = np.concatenate([ids, ids.max() + 1 + np.arange(2 * new)])
    later = make_table(lab, ids=ids.tolist(), angles_deg=table.angles_deg)
    return later, index.renewed(later)


@pytest.mark.parametrize("formula", sorted(FORMULAS))
def test_tree_finds_what_brute_force_finds(formula: str) -> None:
    assert compare(formula, 1, 480) > 5


@pytest.mark.proof
@pytest.mark.timeout(600)
@pytest.mark.parametrize("formula", sorted(FORMULAS))
def test_tree_finds_it_a_hundred_thousand_times(formula: str) -> None:
    assert compare(formula, 2, 16_800) > 500


def test_renewed_index_keeps_its_tree_while_little_changes() -> None:
    rng = np.random.default_rng(3)
    table = a_library(rng, STANDARD)
    index = Index(
        "Test book",
        "gen-1",
        Conditions(STANDARD),
        stock_of(table, Conditions(STANDARD)),
    )
    tree = index.grown(FORMULAS["cie76"]).tree

    _, renewed = changed(rng, table, index)
    other = make_table(paints(rng, PAINTS, 3))

    assert renewed.grown(FORMULAS["cie76"]).tree is tree
    assert renewed.renewed(other).grown(FORMULAS["cie76"]).tree is not tree


def test_tree_looks_at_few_of_many_paints() -> None:
    rng = np.random.default_rng(4)
    lab = paints(rng, 40_000, 3)
    table = make_table(lab)
    index = Index(
        "Test book",
        "gen-1",
        Conditions(STANDARD),
        stock_of(table, Conditions(STANDARD)),
    )
    compared = [
        index.descend(
            Comparison(lab[row] + 0.3, STANDARD, FORMULAS["cie76"]), 10, None
        ).compared
        for row in range(0, 40_000, 1000)
    ]

    assert np.mean(compared) < 0.05 * len(table)
