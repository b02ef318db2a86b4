from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import LibraryError
from paintlink.library import bundled, find, paint_spec
from paintlink.snap import nearest
from tests.snap.conftest import SIX, make_table, make_target

GREY = [[50.0, 0.0, 0.0]] * 3
PAINTS = [GREY, [[53.0, 4.0, 0.0]] * 3, [[40.0, 0.0, 0.0]] * 3]


def test_sum_over_three_angles_is_exact() -> None:
    table = make_table([[[53.0, 4.0, 0.0]] * 3])

    (match,) = nearest(make_target(GREY), table)

    assert match.total == 15.0
    assert match.mean == 5.0


@pytest.mark.parametrize("code", ["RM209", "YS100", "DM001"])
def test_a_paint_is_its_own_nearest(code: str) -> None:
    table = bundled()
    row = find(table, code)

    best, second, *_ = nearest(paint_spec(table, row), table)

    assert (best.code, best.total, best.rank) == (code, 0.0, 1)
    assert second.total > 0.0


def test_ties_are_ordered_by_stable_id() -> None:
    table = make_table([PAINTS[1], GREY, PAINTS[1], GREY], ids=[11, 7, 40, 3])

    found = nearest(make_target(GREY), table)

    assert [match.paint_id for match in found] == [3, 7, 11, 40]


@pytest.mark.parametrize(
    ("standard", "sample", "difference"),
    [
        ((50.0, 2.6772, -79.7751), (50.0, 0.0, -82.7485), 2.0425),
        ((50.0, 2.49, -0.001), (50.0, -2.49, 0.0011), 7.2195),
        ((50.0, 2.5, 0.0), (73.0, 25.0, -18.0), 27.1492),
        ((22.7233, 20.0904, -46.694), (23.0331, 14.973, -42.5619), 2.0373),
        ((2.0776, 0.0795, -1.135), (0.9033, -0.0636, -0.5514), 0.9082),
    ],
)
def test_ciede2000_meets_the_published_pairs(
    standard: tuple[float, ...], sample: tuple[float, ...], difference: float
) -> None:
    table = make_table([[standard] * 3])

    (match,) = nearest(make_target([sample] * 3), table, formula="ciede2000")

    assert match.mean == pytest.approx(difference, abs=5e-5)


def test_differences_are_target_minus_paint() -> None:
    target = make_target([[52.0, 1.0, -3.0], [50.0, 0.0, 0.0], [49.0, 0.0, 0.0]])

    (match,) = nearest(target, make_table([GREY]))

    face, mid, flop = match.differences
    assert (face.aspecular_deg, face.dL, face.da, face.db) == (15.0, 2.0, 1.0, -3.0)
    assert face.dE == np.sqrt(14.0)
    assert (mid.dE, flop.dL) == (0.0, -1.0)


def test_paint_is_the_standard_of_asymmetric_formulas() -> None:
    light, vivid = [[60.0, 5.0, 0.0]] * 3, [[60.0, 60.0, 0.0]] * 3

    (to_vivid,) = nearest(make_target(vivid), make_table([light]), formula="cie94")
    (to_light,) = nearest(make_target(light), make_table([vivid]), formula="cie94")

    # CIE94 divides ΔC by 1 + 0.045 C of the standard.
    assert to_vivid.mean == pytest.approx(55.0 / (1.0 + 0.045 * 5.0))
    assert to_light.mean == pytest.approx(55.0 / (1.0 + 0.045 * 60.0))


def test_answer_names_everything_it_depends_on() -> None:
    (match,) = nearest(make_target(GREY), make_table([GREY]), formula="ciede2000")

    assert match.formula == "ciede2000"
    assert match.angles_deg == (15.0, 45.0, 110.0)
    assert (match.observer, match.library) == ("10", "Test book")
    assert (match.generation, match.finish) == ("gen-1", "metallic")


def test_shorter_list_is_the_beginning_of_a_longer() -> None:
    table = bundled()
    target = paint_spec(table, 5000)

    few, many = nearest(target, table, top=7), nearest(target, table, top=300)

    assert many[:7] == few


def test_fewer_paints_than_asked_for_are_all_returned() -> None:
    mask = np.array([True, False, True])

    found = nearest(make_target(GREY), make_table(PAINTS), top=20, mask=mask)

    assert [match.code for match in found] == ["C0", "C2"]


def test_filtered_list_is_the_full_list_without_the_rest() -> None:
    table = bundled()
    target = paint_spec(table, 5000)
    mask = np.array(table.finishes) == "pearl"

    filtered = nearest(target, table, top=30, mask=mask)

    everything = nearest(target, table, top=len(table))
    pearls = [match.code for match in everything if match.finish == "pearl"]
    assert [match.code for match in filtered] == pearls[:30]


def test_five_and_six_angles_are_compared_on_request() -> None:
    table = bundled()
    target = paint_spec(table, 5000)

    (at_three,) = nearest(target, table, top=1)
    (at_six,) = nearest(target, table, top=1, angles_deg=SIX[::-1])

    assert at_three.angles_deg == (15.0, 45.0, 110.0)
    assert at_six.angles_deg == SIX
    assert len(at_six.differences) == 6


def test_refuses_to_return_no_paint() -> None:
    with pytest.raises(LibraryError, match="asked for the 0 nearest paints"):
        nearest(make_target(GREY), make_table(PAINTS), top=0)


def test_refuses_a_filter_that_leaves_nothing() -> None:
    mask = np.zeros(3, dtype=np.bool_)

    with pytest.raises(LibraryError, match=r"no paint of Test book is left .* widen"):
        nearest(make_target(GREY), make_table(PAINTS), mask=mask)


def test_refuses_an_empty_library() -> None:
    with pytest.raises(LibraryError, match="no paint of Test book is left"):
        nearest(make_target(GREY), make_table(np.empty((0, 3, 3))))


def test_refuses_a_filter_of_another_library() -> None:
    mask = np.ones(5, dtype=np.bool_)

    with pytest.raises(LibraryError, match="made for 5 paints, but Test book has 3"):
        nearest(make_target(GREY), make_table(PAINTS), mask=mask)


def test_design_more_chromatic_than_the_book_finds_rm209() -> None:
    table = bundled()
    lab = paint_spec(table, find(table, "RM209")).lab(15.0, 45.0, 110.0)
    design = make_target(lab * [1.0, 1.35, 1.35])

    best = nearest(design, table, mask=np.array(table.finishes) != "solid")[0]

    assert best.code == "RM209"
    assert best.words.count("more chromatic") == 3


def test_brighter_face_and_darker_flop_are_seen() -> None:
    table = bundled()
    lab = paint_spec(table, find(table, "RM331")).lab(15.0, 45.0, 110.0)
    lab[:, 0] += [6.0, 0.0, -5.0]

    best = nearest(make_target(lab), table)[0]

    assert best.code == "RM331"
    assert best.words == "target: face 6.0 lighter, flop 5.0 darker"
