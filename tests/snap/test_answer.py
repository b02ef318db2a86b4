"""The whole answer: second ranks, relations, variants, confidence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.library import bundled, find, paint_spec
from paintlink.model import Facet, FloatArray
from paintlink.snap import INDEXES, Options, answer, confidence, nearest
from paintlink.snap.conditions import Conditions
from tests.snap.conftest import STANDARD, make_table, make_target

GREY = np.array([[50.0, 0.0, 0.0]] * 3)
RED = np.array([[50.0, 40.0, 20.0]] * 3)


def moved(lab: FloatArray, lightness: float, da: float, db: float) -> FloatArray:
    return lab + np.array([lightness, da, db])


def test_list_is_the_one_of_the_search() -> None:
    table = bundled()
    spec = paint_spec(table, find(table, "RM209"))

    found = answer(spec, table, Options(top=7, formula="ciede2000"))

    assert found.matches == nearest(spec, table, top=7, formula="ciede2000")


def test_one_answer_grows_no_tree_and_later_ones_do() -> None:
    table = replace(bundled(), library="Asked first")
    spec = paint_spec(table, 4321, angles_deg=STANDARD)

    grown = []
    for _ in range(2):
        answer(spec, table)
        grown.append(bool(INDEXES.of(table, Conditions(STANDARD)).trees))

    assert grown == [False, True]


def test_second_formula_gives_its_own_rank() -> None:
    table = bundled()
    lab = paint_spec(table, 4321).lab(15.0, 45.0, 110.0) * (1.0, 1.2, 0.8)
    spec = make_target(lab)

    found = answer(spec, table, Options(top=10))

    by_second = [m.code for m in nearest(spec, table, top=6000, formula="ciede2000")]
    ranks = [by_second.index(match.code) + 1 for match in found.matches]
    assert found.second_formula == "ciede2000"
    assert found.second_ranks == tuple(r if r <= 50 else None for r in ranks)
    assert list(found.second_ranks) != sorted(ranks)


def test_relations_say_how_a_paint_differs_from_the_target() -> None:
    table = make_table([
        RED,
        moved(RED, 3.0, 0.0, 0.0),
        moved(RED, -4.0, 0.0, 0.0),
        RED * (1.0, 1.2, 1.2),
        RED[:, [0, 2, 1]],
    ])

    found = answer(make_target(moved(RED, 0.2, 0.0, 0.0)), table)

    codes = {name: match.code for name, match in found.relations.items()}
    assert codes == {
        "closest": "C0",
        "lighter": "C1",
        "darker": "C2",
        "more chromatic": "C3",
        "same hue": "C0",
    }


def test_relation_that_no_paint_has_is_left_out() -> None:
    found = answer(make_target(GREY), make_table([moved(GREY, 5.0, 0.0, 0.0)]))

    assert set(found.relations) == {"closest", "lighter", "same hue"}


def test_variants_of_one_paint_stand_together() -> None:
    table = make_table([moved(GREY, step, 0.0, 0.0) for step in range(5)])
    groups = Facet(("A", "B"), np.array([0, 1, 0, -1, -1], dtype=np.int32))
    table = replace(table, facets={"variant_group": groups})

    found = answer(make_target(GREY), table)

    assert found.variants == ((1, 3),)


def test_first_rank_is_sure_where_the_second_is_far() -> None:
    table = make_table([GREY, GREY + 3.0])
    spec = make_target(GREY + 0.05)

    found = confidence(spec, nearest(spec, table), 0.1)

    assert found.stays_first == 1.0
    assert found.margin == pytest.approx(3 * (2.95 - 0.05) * np.sqrt(3.0))


def test_first_rank_between_two_paints_is_a_coin_toss() -> None:
    table = make_table([GREY, moved(GREY, 0.2, 0.0, 0.0)])
    spec = make_target(moved(GREY, 0.1, 0.0, 0.0))

    found = confidence(spec, nearest(spec, table), 0.3)

    assert 0.4 < found.stays_first < 0.6
    assert found.margin == pytest.approx(0.0, abs=1e-9)


def test_worse_repeatability_makes_the_first_rank_less_sure() -> None:
    table = make_table([GREY, moved(GREY, 0.4, 0.0, 0.0)])
    spec = make_target(moved(GREY, 0.15, 0.0, 0.0))
    matches = nearest(spec, table)

    shares = [confidence(spec, matches, r).stays_first for r in (0.02, 0.2, 1.0)]

    assert shares == sorted(shares, reverse=True)
    assert shares[0] == 1.0
    assert shares[-1] < 0.8


def test_only_paint_has_no_margin_and_stays_first() -> None:
    spec = make_target(GREY)

    found = confidence(spec, nearest(spec, make_table([GREY])))

    assert (found.margin, found.stays_first) == (None, 1.0)
