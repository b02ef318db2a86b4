from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.cells import pixels
from paintlink.sketch.floor import Floor, floor, misfit
from paintlink.sketch.transfer import shown

RNG = np.random.default_rng(4)
THETA, PHI = RNG.uniform(12.0, 140.0, 30_000), RNG.uniform(0.2, 1.0, 30_000)
STEEP = np.exp(-THETA / 25.0)
LAB = np.stack([20.0 + 70.0 * STEEP, 9.0 * STEEP, 0.0 * STEEP], axis=-1)


def test_any_paint_has_next_to_no_floor():
    found = floor(pixels(THETA, PHI, shown(LAB, PHI, 0.5), 0.5))

    assert found.mean < 0.3
    assert found.sentence.startswith("a paint can look like this: best possible is")


def test_shading_against_the_form_has_a_high_floor():
    white = np.broadcast_to([90.0, 0.0, 0.0], LAB.shape)

    found = floor(pixels(THETA, PHI, shown(white, 1.2 - PHI, 0.9), 0.9))

    assert found.mean > 5.0
    assert not found.consistent


@pytest.mark.parametrize(
    ("mean", "words"),
    [
        (2.0, "a paint can look like this: best possible is dE00 2.0"),
        (4.9, "a paint can look roughly like this: best possible is dE00 4.9"),
        (7.2, "no paint looks like this: best possible is dE00 7.2; paint with the"),
    ],
)
def test_floor_says_what_it_means(mean, words):
    assert Floor(mean).sentence.startswith(words)


def test_misfit_ignores_what_the_display_clips():
    white = np.ones((1, 3))

    left = misfit(white, np.array([[140.0, 0.0, 0.0]]), np.ones(1), 1.0)

    assert left == pytest.approx(0.0, abs=1e-6)
