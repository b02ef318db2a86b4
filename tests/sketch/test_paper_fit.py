from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.color import lab_to_linear_srgb
from paintlink.color.display import encode_srgb
from paintlink.sketch.paper_fit import (
    CLAMPS_DEG,
    clamped_least_squares,
    paper_lab,
    paper_rgb,
)
from paintlink.sketch.selection import select
from paintlink.sketch.transfer import linear_srgb_to_lab
from paintlink.sketch.values import Painting
from tests.sketch.synthesis import Setup, picture, sphere

SETUP = Setup.of(sphere(192))
EXPOSURE = 0.9


def powers(theta: np.ndarray, clamp_deg: float) -> np.ndarray:
    return (np.minimum(theta, clamp_deg) / 110.0)[..., np.newaxis] ** np.arange(3)


def selected(reflectance):
    encoded = picture(SETUP.geometry, reflectance, EXPOSURE)
    chosen = select(Painting(encoded), SETUP.geometry, SETUP.start)
    return chosen.theta_deg, chosen.phi, chosen.encoded, EXPOSURE


@settings(max_examples=20, deadline=None)
@given(
    st.integers(25, 110),
    st.tuples(*[st.floats(0.1, 0.4)] * 3),
    st.tuples(*[st.floats(0.4, 1.2)] * 3),
)
def test_pictures_of_the_model_give_it_back(clamp, flop, travel):
    travel = np.array(travel) * np.array(flop)
    truth = np.stack([flop + travel, -1.2 * travel, 0.4 * travel])

    found = paper_rgb(*selected(lambda theta: powers(theta, clamp) @ truth))

    assert found.clamp_deg == clamp
    assert found.coefficients == pytest.approx(truth, abs=1e-9)


def test_pictures_of_the_lab_model_give_it_back():
    truth = np.array([[80.0, 20.0, -5.0], [-90.0, -30.0, 3.0], [45.0, 15.0, 2.0]])

    found = paper_lab(
        *selected(lambda theta: lab_to_linear_srgb(powers(theta, 64.0) @ truth))
    )

    assert found.clamp_deg == 64.0
    assert found.coefficients == pytest.approx(truth, abs=1e-9)
    assert found.lab([45.0, 110.0]) == pytest.approx(
        powers(np.array([45.0, 64.0]), 64.0) @ truth
    )


def test_clamp_between_two_steps_costs_little():
    truth = np.array([[0.6] * 3, [-0.9] * 3, [0.5] * 3])

    found = paper_rgb(*selected(lambda theta: powers(theta, 62.5) @ truth))

    right = linear_srgb_to_lab(powers(np.array([15.0, 45.0, 110.0]), 62.5) @ truth)
    assert abs(found.clamp_deg - 62.5) == 0.5
    assert found.lab([15.0, 45.0, 110.0]) == pytest.approx(right, abs=0.05)


def test_scan_by_sums_picks_what_pixelwise_solutions_pick():
    rng = np.random.default_rng(5)
    theta, factor = rng.uniform(12.0, 150.0, 3000), rng.uniform(0.2, 1.0, 3000)
    paint = powers(theta, 70.0) @ np.array([[0.9] * 3, [-1.2] * 3, [0.6] * 3])
    values = factor[:, np.newaxis] * (paint + rng.normal(0.0, 0.05, (3000, 3)))

    found, clamp = clamped_least_squares(theta, factor, values)

    errors, solutions = [], []
    for step in CLAMPS_DEG:
        rows = factor[:, np.newaxis] * powers(theta, step)
        solution, left, *_ = np.linalg.lstsq(rows, values, rcond=None)
        errors.append(left.sum())
        solutions.append(solution)
    assert clamp == CLAMPS_DEG[np.argmin(errors)]
    assert found == pytest.approx(solutions[np.argmin(errors)], abs=1e-9)


def test_solid_paint_is_fitted_by_any_clamp():
    found = paper_rgb(*selected(lambda theta: np.full((*theta.shape, 3), 0.3)))

    levels = found.lab([15.0, 45.0, 110.0])

    assert levels == pytest.approx(np.tile(levels[0], (3, 1)), abs=1e-9)


def test_encoded_black_is_a_valid_pixel():
    theta, phi = np.linspace(12, 120, 500), np.full(500, 0.5)

    found = paper_rgb(theta, phi, encode_srgb(np.zeros((500, 3))), 1.0)

    assert found.lab([45.0])[0] == pytest.approx([0.0] * 3, abs=1e-9)
