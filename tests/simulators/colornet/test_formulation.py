from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink_simulators.colornet import Target, adjusted, formulate
from paintlink_simulators.paint import amounts
from tests.simulators.colornet.panels import ANGLES, Book, drawn

SEED = 11


@pytest.fixture(scope="module")
def book() -> Book:
    return Book(1500, SEED)


def unseen(number: int) -> list[Target]:
    rng = np.random.default_rng(SEED + 1)
    blank = Target(ANGLES, np.zeros((3, 3)))
    labs = blank.predicted(amounts([drawn(rng) for _ in range(number)]))
    return [Target(ANGLES, lab) for lab in labs]


def test_unseen_paints_are_matched(book):
    found = [formulate(target, book.nearest(target.lab)) for target in unseen(25)]

    means = np.array([one.mean_difference for one in found])
    assert np.median(means) < 0.25
    assert np.mean(means <= 1.0) >= 0.9


def test_formulas_are_weighable_and_their_colour_is_true(book):
    for target in unseen(8):
        found = formulate(target, book.nearest(target.lab))

        parts = np.array(list(found.parts.values()))
        assert round(float(parts.sum()), 6) == 100.0
        np.testing.assert_allclose(parts, np.round(parts, 2), atol=1e-9)
        assert parts.min() >= 0.01
        predicted = target.predicted(amounts([found.parts]))[0]
        np.testing.assert_array_equal(found.predicted, predicted)
        np.testing.assert_allclose(
            found.difference, target.difference(predicted), atol=1e-12
        )


def test_formulas_stay_within_eight_toners_and_say_which_were_added(book):
    for target in unseen(8):
        starts = book.nearest(target.lab)

        found = formulate(target, starts)

        assert len(found.parts) <= 8
        assert set(found.added) == set(found.parts) - set(starts[found.start])


def test_a_known_formula_is_found_again():
    start = {"A03": 40.0, "B71": 35.0, "N20": 5.0, "W10": 20.0}
    near = {"A03": 50.0, "B71": 25.0, "N20": 8.0, "W10": 17.0}
    blank = Target(ANGLES, np.zeros((3, 3)))
    target = Target(ANGLES, blank.predicted(amounts([start]))[0])

    found = formulate(target, [near])

    assert found.added == ()
    assert found.mean_difference < 0.1
    for code, parts in start.items():
        assert found.parts[code] == pytest.approx(parts, abs=1.0)


def test_a_missing_colour_is_added():
    blank = Target(ANGLES, np.zeros((3, 3)))
    blue = {"A03": 50.0, "B71": 45.0, "N20": 5.0}
    target = Target(ANGLES, blank.predicted(amounts([blue]))[0])

    found = formulate(target, [{"A03": 90.0, "N20": 10.0}])

    assert "B71" in found.added
    assert found.mean_difference < 1.0


def test_adjusting_adds_nothing():
    target = Target(ANGLES, np.array([[90.0, 0.0, 0.0]] * 3))

    found = adjusted(target, {"A03": 90.0, "N20": 10.0})

    assert set(found.parts) <= {"A03", "N20"}


def test_what_no_paint_can_do_stays_far_off(book):
    impossible = Target(ANGLES, np.array([[20.0, 0, 0], [90.0, 60, 60], [20.0, 0, 0]]))

    found = formulate(impossible, book.nearest(impossible.lab))

    assert found.mean_difference > 10.0


def test_the_first_start_that_is_good_enough_is_taken():
    blank = Target(ANGLES, np.zeros((3, 3)))
    red = {"R52": 60.0, "A03": 30.0, "N20": 10.0}
    target = Target(ANGLES, blank.predicted(amounts([red]))[0])

    assert formulate(target, [red, {"W10": 100.0}]).start == 0
    assert formulate(target, [{"W10": 100.0}, red]).start in {0, 1}


def test_no_start_is_refused():
    with pytest.raises(InputError, match="no known formula to start from: name a"):
        formulate(Target(ANGLES, np.zeros((3, 3))), [])


def test_unknown_toners_are_refused():
    with pytest.raises(InputError, match="has no toner 'X99'"):
        formulate(Target(ANGLES, np.zeros((3, 3))), [{"X99": 100.0}])


def test_flop_control_never_stands_alone():
    target = Target(ANGLES, np.array([[60.0, 0, 0], [40.0, 0, 0], [30.0, 0, 0]]))

    found = formulate(target, [{"F90": 99.999, "A03": 0.001}])

    assert set(found.parts) - {"F90"}
    assert round(sum(found.parts.values()), 6) == 100.0
