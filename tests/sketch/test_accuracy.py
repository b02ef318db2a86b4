from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.fit import ANGLES_DEG
from tests.sketch import trials
from tests.sketch.synthesis import Setup, sphere
from tests.sketch.trials import DAUBED, EXACT, JPEG, PNG, trial

SETUP = Setup.of(sphere(256))
SOME, MANY = 16, 200
NUMBERS = [
    pytest.param(SOME, id="some"),
    pytest.param(MANY, id="many", marks=[pytest.mark.proof, pytest.mark.timeout(600)]),
]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize(
    ("damage", "limit", "limit_black"), [(EXACT, 0.03, 0.03), (PNG, 0.15, 0.5)]
)
def test_undamaged_paints_come_back_exactly(number, damage, limit, limit_black):
    paints = trials.library_paints(number)
    # Below L* 15 a flop is a handful of codes deep in an 8-bit file.
    black = np.array([paint.curve(ANGLES_DEG)[:, 0].min() < 15.0 for paint in paints])

    local = trial(SETUP, paints, damage)["local"]

    assert local.measured > 0.98
    assert local.values[~black].max() <= limit
    assert local.values.max() <= limit_black


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
    # A JPEG rounds the chroma of smooth areas to whole codes: greys suffer.
    assert (local.p90 <= [1.0, 1.0, 1.0, 1.2, 1.4]).all()


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
