from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import default_model, drawing_curve, fit
from paintlink.errors import SpecError

THREE = (15.0, 45.0, 110.0)
FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
SIX = (-15.0, *FIVE)
BLUE = np.array([
    [105.06, 25.49, -53.36],
    [89.12, 25.11, -50.60],
    [59.95, 20.72, -37.29],
    [31.61, 10.99, -19.44],
    [15.39, 7.36, -13.30],
    [10.15, 6.88, -10.08],
])


@pytest.mark.parametrize(
    ("angles", "model"),
    [
        (THREE, "clamped"),
        ((25.0, 45.0, 75.0), "clamped"),
        ((-15.0, 45.0, 110.0), "pchip"),
        (FIVE, "pchip"),
        (SIX, "pchip"),
    ],
)
def test_default_model_follows_the_angles(angles, model):
    assert default_model(angles) == model


@pytest.mark.parametrize("model", ["clamped", "paper_literal", "pchip"])
def test_curve_says_what_it_is(model):
    curve = fit([15, 25, 45, 75, 110], BLUE[1:], model)

    assert curve.model == model
    assert curve.angles_deg == FIVE


@pytest.mark.parametrize(
    ("angles", "rows", "message"),
    [
        ((15, 45), 2, "at least three aspecular angles.*found '15, 45'"),
        ((45, 15, 110), 3, "ascending order.*found '45, 15, 110'"),
        ((15, 15, 110), 3, "ascending order"),
        (THREE, 5, r"Lab of shape \(5, 3\) does not fit 3 angles"),
    ],
)
def test_unfit_angles_are_refused(angles, rows, message):
    with pytest.raises(SpecError, match=message):
        fit(angles, BLUE[:rows], "pchip")


@pytest.mark.parametrize("model", ["clamped", "paper_literal"])
def test_quadratics_need_three_near_angles(model):
    with pytest.raises(SpecError, match=f"the {model} curve needs three angles above"):
        fit((-15, 15, 45), BLUE[:3], model)


@pytest.mark.parametrize(
    ("angles", "lab"),
    [(THREE, BLUE[[1, 3, 5]]), (FIVE, BLUE[1:]), (SIX, BLUE)],
    ids=["three", "five", "six"],
)
def test_drawing_runs_to_zero_without_jump(angles, lab):
    curve = drawing_curve(angles, lab)

    face = curve([0, 5, 10, 15 - 1e-9])[:, 0]
    assert (np.diff(face) < 0).all()
    assert face[-1] == pytest.approx(89.12, abs=1e-6)
    assert np.array_equal(curve([-40, -1]), curve([0, 0]))


@pytest.mark.parametrize("rows", [[1, 3, 5], [1, 2, 3, 4, 5]], ids=["three", "five"])
def test_drawing_keeps_the_measurements(rows):
    angles = tuple(SIX[row] for row in rows)

    curve = drawing_curve(angles, BLUE[rows])

    assert curve(angles) == pytest.approx(BLUE[rows], abs=1e-12)
    assert curve([110, 150, 180]) == pytest.approx(BLUE[[5, 5, 5]], abs=1e-12)


def test_drawing_continues_the_same_quadratic():
    curve = drawing_curve(THREE, [[130, 0, 0], [61, 0, 0], [33, 0, 0]])

    slope, vertex = 0.02307720689, 79.8327203795
    assert curve(0.0)[0] == pytest.approx(33 + slope * vertex**2, abs=1e-4)


def test_drawing_draws_one_face_for_all():
    below = np.linspace(0, 14.9, 20)

    three, six = drawing_curve(THREE, BLUE[[1, 3, 5]]), drawing_curve(SIX, BLUE)

    assert np.array_equal(three(below), six(below))


def test_drawing_follows_pchip_between_five():
    asked = np.linspace(15, 180, 60)

    drawn = drawing_curve(FIVE, BLUE[1:])

    assert np.array_equal(drawn(asked), fit(FIVE, BLUE[1:], "pchip")(asked))
    assert drawn.model == "pchip"


def test_drawing_leaves_far_side_out():
    asked = np.linspace(0, 180, 60)

    six, five = drawing_curve(SIX, BLUE), drawing_curve(FIVE, BLUE[1:])

    assert np.array_equal(six(asked), five(asked))
    assert six.angles_deg == FIVE


def test_drawing_manages_without_near_angles():
    curve = drawing_curve((-15, 15, 45), BLUE[[0, 1, 3]])

    assert curve([-15, 15, 45, 110]) == pytest.approx(BLUE[[0, 1, 3, 3]], abs=1e-12)


def test_drawing_of_a_solid_is_flat():
    solid = np.tile([43.21, 56.7, -35.9], (5, 1))

    values = drawing_curve(FIVE, solid)(np.linspace(0, 180, 60))

    assert np.array_equal(values, np.tile(solid[0], (60, 1)))


def test_drawing_serves_a_whole_library():
    library = np.random.default_rng(2).uniform(0, 100, (200, 5, 3))
    asked = np.linspace(0, 110, 9)

    together = drawing_curve(FIVE, library)(asked)

    assert together.shape == (200, 9, 3)
    assert together[17] == pytest.approx(drawing_curve(FIVE, library[17])(asked))
