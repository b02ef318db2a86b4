"""The search against a brute force that is slow, literal and written apart from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from numpy.random import Generator
from numpy.typing import NDArray

from paintlink.color import FORMULAS
from paintlink.library import bundled
from paintlink.model import FloatArray, Match, PaintTable
from paintlink.snap import nearest
from tests.snap.conftest import SIX, STANDARD, make_table, make_target

Total = Callable[[Sequence[Sequence[float]], Sequence[Sequence[float]]], float]
Angles = tuple[float, ...]
Ranked = list[tuple[float, int]]
CENTRE = (50.0, 3.0, -2.0)


def cie76_by_hand(
    paint: Sequence[Sequence[float]], target: Sequence[Sequence[float]]
) -> float:
    total = 0.0
    for (l1, a1, b1), (l2, a2, b2) in zip(paint, target, strict=True):
        dl, da, db = l2 - l1, a2 - a1, b2 - b1
        total += math.sqrt((dl * dl + da * da) + db * db)
    return total


def one_paint_at_a_time(formula: str, angles: Angles) -> Total:
    def total(
        paint: Sequence[Sequence[float]], target: Sequence[Sequence[float]]
    ) -> float:
        added = 0.0
        for difference in FORMULAS[formula](paint, target, angles).tolist():
            added += difference
        return added

    return total


def brute_force(
    table: PaintTable,
    target: FloatArray,
    angles: Angles,
    total: Total,
    mask: NDArray[np.bool_] | None = None,
) -> Ranked:
    columns = [table.angles_deg.index(angle) for angle in angles]
    rows = range(len(table)) if mask is None else np.flatnonzero(mask).tolist()
    return sorted(
        (total(table.lab[row, columns].tolist(), target.tolist()), int(table.ids[row]))
        for row in rows
    )


def ranked(matches: tuple[Match, ...]) -> Ranked:
    return [(match.total, match.paint_id) for match in matches]


def crowded_table(rng: Generator, rows: int) -> PaintTable:
    """Lab on a coarse grid with repeated rows, so that exact ties are common."""
    lab = rng.integers(-2, 3, (rows, 6, 3)) * 0.5 + CENTRE
    lab[rng.integers(0, rows, rows // 4)] = lab[rng.integers(0, rows, rows // 4)]
    ids = rng.permutation(np.cumsum(rng.integers(1, 5, rows))).tolist()
    return make_table(lab, ids=ids, angles_deg=SIX)


def some_angles(rng: Generator) -> Angles:
    chosen = rng.choice(SIX, size=int(rng.integers(1, 7)), replace=False)
    return tuple(sorted(chosen.tolist()))


def some_mask(rng: Generator, rows: int) -> NDArray[np.bool_] | None:
    mask = rng.random(rows) < rng.choice([0.1, 0.5, 2.0])
    mask[int(rng.integers(rows))] = True
    return None if mask.all() else mask


def compare(
    formula: str, total: Callable[[Angles], Total], seed: int, queries: int
) -> int:
    """Hold random questions against the brute force; count the answers with ties."""
    rng = np.random.default_rng(seed)
    ties = 0
    for query in range(queries):
        if query % 50 == 0:
            table = crowded_table(rng, 100)
        target = rng.integers(-4, 5, (6, 3)) * 0.25 + CENTRE
        angles, mask = some_angles(rng), some_mask(rng, len(table))
        top = int(rng.integers(1, 40))
        at = [SIX.index(angle) for angle in angles]
        expected = brute_force(table, target[at], angles, total(angles), mask)[:top]

        found = nearest(
            make_target(target, angles_deg=SIX),
            table,
            top=top,
            formula=formula,
            angles_deg=angles,
            mask=mask,
        )

        assert ranked(found) == expected
        ties += len({total for total, _ in expected}) < len(expected)
    return ties


@pytest.mark.parametrize("seed", range(3))
def test_cie76_equals_brute_force_in_every_bit(seed: int) -> None:
    assert compare("cie76", lambda _: cie76_by_hand, seed, 700) > 100


@pytest.mark.parametrize("formula", sorted(FORMULAS))
def test_every_formula_equals_brute_force(formula: str) -> None:
    assert compare(formula, lambda a: one_paint_at_a_time(formula, a), 1, 40) > 5


@pytest.mark.proof
@pytest.mark.parametrize("seed", range(100, 110))
def test_cie76_equals_brute_force_ten_thousand_times(seed: int) -> None:
    assert compare("cie76", lambda _: cie76_by_hand, seed, 10_000) > 1000


@pytest.mark.proof
@pytest.mark.parametrize("seed", range(100, 105))
def test_ciede2000_equals_brute_force_a_thousand_times(seed: int) -> None:
    formula = "ciede2000"

    assert compare(formula, lambda a: one_paint_at_a_time(formula, a), seed, 1000) > 99


@pytest.mark.parametrize("formula", ["cie76", "ciede2000"])
def test_whole_library_equals_brute_force(formula: str) -> None:
    rng = np.random.default_rng(6000)
    table = bundled()
    total = {
        "cie76": cie76_by_hand,
        "ciede2000": one_paint_at_a_time("ciede2000", STANDARD),
    }[formula]
    at = [SIX.index(angle) for angle in STANDARD]
    for _ in range(8 if formula == "cie76" else 2):
        target = table.lab[int(rng.integers(6000))][at] + rng.normal(0.0, 2.0, (3, 3))
        expected = brute_force(table, target, STANDARD, total)

        found = nearest(make_target(target), table, top=50, formula=formula)

        assert ranked(found) == expected[:50]


@pytest.mark.parametrize("formula", ["cie76", "ciede2000"])
def test_total_is_the_sum_of_its_differences(formula: str) -> None:
    table = bundled()
    target = make_target(table.lab[4321, [1, 3, 5]] + 1.0 / 3.0)

    for match in nearest(target, table, formula=formula):
        total = 0.0
        for difference in match.differences:
            total += difference.dE

        assert match.total == total


def test_layout_of_the_library_changes_no_bit() -> None:
    table = bundled()
    copy = make_table(np.ascontiguousarray(table.lab), angles_deg=table.angles_deg)
    target = make_target(table.lab[1234, [1, 3, 5]] + 0.7)

    for formula in FORMULAS:
        ours = nearest(target, table, formula=formula)
        theirs = nearest(target, copy, formula=formula)

        assert ranked(ours) == ranked(theirs)
