"""Many targets at once give what each gives alone."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import FORMULAS
from paintlink.snap.batch import SCAN_UP_TO, Question, nearest_many
from paintlink.snap.conditions import Comparison, Conditions
from paintlink.snap.index import Index
from paintlink.snap.stock import stock_of
from tests.snap.conftest import STANDARD, make_table
from tests.snap.oracle import paints, targets


def an_index(count: int, seed: int = 1) -> Index:
    rng = np.random.default_rng(seed)
    ids = rng.permutation(count).tolist()
    table = make_table(paints(rng, count, 3), ids=ids)
    conditions = Conditions(STANDARD)
    return Index("Test book", "gen-1", conditions, stock_of(table, conditions))


@pytest.mark.parametrize("formula", ["cie76", "ciede2000"])
@pytest.mark.parametrize("count", [5, 400, SCAN_UP_TO + 1])
@pytest.mark.parametrize("masked", [False, True])
def test_batch_gives_what_single_searches_give(
    formula: str, count: int, masked: bool
) -> None:
    index = an_index(count)
    rng = np.random.default_rng(2)
    lab = index.stock.planes.transpose(2, 0, 1)
    asked = np.array([targets(rng, lab) for _ in range(70 if count < 1000 else 9)])
    allowed = rng.random(count) < 0.5 if masked else None
    question = Question(FORMULAS[formula], 7, allowed)

    together = list(nearest_many(index, asked, question))

    assert len(together) == len(asked)
    for target, found in zip(asked, together, strict=True):
        comparison = Comparison(target, STANDARD, FORMULAS[formula])
        alone = index.scan(comparison, 7, allowed)
        assert found.positions.tolist() == alone.positions.tolist()
        assert found.totals.tobytes() == alone.totals.tobytes()
        assert found.differences.tobytes() == alone.differences.tobytes()


def test_no_target_gives_no_list() -> None:
    question = Question(FORMULAS["cie76"], 3)

    assert not list(nearest_many(an_index(50), np.empty((0, 3, 3)), question))
