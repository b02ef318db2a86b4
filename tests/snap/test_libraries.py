"""Several libraries at once, and libraries that change."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.errors import LibraryError
from paintlink.model import PaintTable
from paintlink.snap import nearest, nearest_of_all
from tests.snap.conftest import SIX, make_table, make_target
from tests.snap.oracle import paints

GREY = [[50.0, 0.0, 0.0]] * 3


def a_book(name: str, seed: int, angles: tuple[float, ...]) -> PaintTable:
    lab = paints(np.random.default_rng(seed), 200, len(angles))
    return replace(make_table(lab, angles_deg=angles), library=name)


def test_two_libraries_give_one_ranked_list() -> None:
    first = a_book("First", 1, (15.0, 45.0, 110.0))
    second = a_book("Second", 2, SIX)
    target = make_target(GREY)

    found = nearest_of_all(target, [first, second], top=12)

    apart = [*nearest(target, first, top=12), *nearest(target, second, top=12)]
    expected = sorted(apart, key=lambda match: match.total)[:12]
    assert [m.rank for m in found] == list(range(1, 13))
    assert [(m.total, m.library, m.code) for m in found] == [
        (m.total, m.library, m.code) for m in expected
    ]
    assert {m.library for m in found} == {"First", "Second"}


def test_all_libraries_are_compared_at_the_same_angles() -> None:
    five = a_book("Five", 1, (15.0, 25.0, 45.0, 75.0, 110.0))
    without_15 = a_book("Without 15", 2, (25.0, 45.0, 75.0, 110.0))
    target = make_target([[50.0, 0.0, 0.0]] * 6, angles_deg=SIX)

    found = nearest_of_all(target, [five, without_15], top=400)

    assert {m.angles_deg for m in found} == {(25.0, 45.0, 75.0, 110.0)}
    assert {m.library for m in found} == {"Five", "Without 15"}


def test_library_emptied_by_its_filter_adds_nothing() -> None:
    books = [a_book("First", 1, SIX), a_book("Second", 2, SIX)]
    nobody = np.zeros(200, dtype=np.bool_)
    target = make_target(np.full((6, 3), 50.0), angles_deg=SIX)

    found = nearest_of_all(target, books, masks=[nobody, None])

    assert {m.library for m in found} == {"Second"}
    with pytest.raises(LibraryError, match="no paint of 2 libraries is left"):
        nearest_of_all(target, books, masks=[nobody, nobody])


def test_changed_library_is_searched_as_it_is_now() -> None:
    table = make_table([GREY, [[60.0, 0.0, 0.0]] * 3], ids=[4, 5])
    target = make_target(GREY)

    before = nearest(target, table, top=1)[0]
    renamed = replace(table, generation="gen-2", lab=table.lab[::-1].copy())
    after = nearest(target, renamed, top=1)[0]
    again = nearest(target, table, top=1)[0]

    assert (before.code, before.generation) == ("C0", "gen-1")
    assert (after.code, after.generation) == ("C1", "gen-2")
    assert again == before


def test_large_library_gives_the_same_list_by_scan_and_by_tree() -> None:
    table = make_table(paints(np.random.default_rng(7), 9000, 3))
    target = make_target(table.lab[77] + 0.4)

    by_scan = nearest(target, table, top=30)
    by_tree = nearest(target, table, top=30)

    assert by_scan == by_tree
