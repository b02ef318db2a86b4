from __future__ import annotations

import numpy as np
import pytest

from tests.sketch import trials
from tests.sketch.synthesis import Setup, sphere
from tests.sketch.trials import ADOBE, DAUBED, EXACT, JPEG, P3, PNG, trial

SETUP = Setup.of(sphere(256))
SOME, MANY = 16, 200
NUMBERS = [
    pytest.param(SOME, id="some"),
    pytest.param(MANY, id="many", marks=[pytest.mark.proof, pytest.mark.timeout(600)]),
]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(("damage", "limit"), [(EXACT, 0.03), (PNG, 0.15)])
def test_undamaged_paints_come_back_exactly(number, damage, limit):
    local = trial(SETUP, trials.library_paints(number), damage)["local"]

    assert local.measured > 0.98
    assert local.largest.max() <= limit


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("damage", [ADOBE, P3], ids=["adobe", "p3"])
def test_embedded_profiles_cost_little(number, damage):
    local = trial(SETUP, trials.library_paints(number), damage)["local"]

    assert local.measured > 0.98
    assert local.largest.max() <= 0.3


@pytest.mark.parametrize("number", NUMBERS)
def test_noise_and_strokes_hardly_matter(number):
    local = trial(SETUP, trials.library_paints(number), DAUBED)["local"]

    assert local.measured > 0.98
    assert local.median.max() <= 0.2
    assert local.p90.max() <= 0.6


@pytest.mark.parametrize("number", NUMBERS)
def test_compression_costs_little(number):
    local = trial(SETUP, trials.library_paints(number), JPEG)["local"]

    assert local.measured > 0.98
    assert local.median.max() <= 0.4
    assert local.p90.max() <= 1.0


def test_steep_real_paints_come_back():
    paints = trials.real_paints()
    if not paints:
        pytest.skip("../shared/data is absent")

    local = trial(SETUP, paints, DAUBED)["local"]

    assert local.median.max() <= 0.4
    assert local.p90.max() <= 1.5


def test_pearls_need_more_than_the_paper_in_rgb():
    errors = trial(SETUP, trials.pearl_paints(SOME), PNG)

    assert errors["local"].median[4] <= errors["paper RGB"].median[4] - 1.0
    assert np.all(errors["local"].median <= errors["paper Lab"].median + 0.01)
