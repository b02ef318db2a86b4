from __future__ import annotations

import numpy as np
import pytest

from paintlink_simulators.colornet import Attempt, Target, correct, formulate
from paintlink_simulators.paint import (
    BODY_SHOP_SITE,
    CAREFUL_SITE,
    EXACT_SITE,
    SprayBooth,
    Variation,
    amounts,
)
from tests.simulators.colornet.panels import ANGLES, Book, drawn, read

SEED = 7
PANELS = 3


@pytest.fixture(scope="module")
def book() -> Book:
    return Book(3000, SEED)


def sessions(book: Book, site: Variation, number: int) -> np.ndarray:
    """Mean CIEDE2000 of three panels a job, two corrections, shape (jobs, 3)."""
    rng = np.random.default_rng(SEED + 1)
    return np.array([
        session(book, site, seed, SprayBooth(EXACT_SITE, seed=seed).spray(drawn(rng)))
        for seed in range(number)
    ])


def session(book, site, seed, panel) -> list[float]:
    rng = np.random.default_rng(seed)
    booth = SprayBooth(site, seed=seed)
    target = Target(ANGLES, read(panel, rng, site.reading))
    found = formulate(target, book.nearest(target.lab))
    attempts: list[Attempt] = []
    for _ in range(PANELS):
        if attempts:
            found = correct(target, attempts)
        measured = read(booth.spray(found.parts), rng, site.reading)
        attempts.append(Attempt(found.parts, found.predicted, measured))
    return [float(target.mean_difference(one.measured)) for one in attempts]


def test_corrections_take_out_what_the_cans_differ_by(book):
    cans = Variation(EXACT_SITE.reading, EXACT_SITE.application, batch=0.05, weighing=0)

    panels = sessions(book, cans, 12)

    assert np.median(panels[:, 1]) < 0.7 * np.median(panels[:, 0])


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("site", "best", "closed"),
    [
        pytest.param(CAREFUL_SITE, 0.35, 0.95, id="laboratory"),
        pytest.param(BODY_SHOP_SITE, 0.5, 0.88, id="body shop"),
    ],
)
def test_two_hundred_unseen_panels_are_matched(book, site, best, closed):
    panels = sessions(book, site, 200)

    second = panels[:, 1]
    nearest = panels.min(axis=1)
    assert np.median(nearest) <= best
    assert np.mean(nearest <= 1.0) >= closed
    if site is CAREFUL_SITE:
        assert np.median(second) <= 0.5
        assert np.percentile(second, 95) <= 1.2


def test_the_best_panel_is_continued_from():
    near = {"A03": 40.0, "B71": 35.0, "N20": 5.0, "W10": 20.0}
    far = {"R52": 60.0, "A03": 40.0}
    blank = Target(ANGLES, np.zeros((3, 3)))
    labs = blank.predicted(amounts([near, far]))
    attempts = [Attempt(far, labs[1], labs[1]), Attempt(near, labs[0], labs[0])]

    found = correct(Target(ANGLES, labs[0]), attempts)

    assert set(found.parts) == set(near)


def test_a_correction_that_leaves_the_target_is_not_given():
    silver = {"A03": 90.0, "N20": 10.0}
    blank = Target(ANGLES, np.zeros((3, 3)))
    lab = blank.predicted(amounts([silver]))[0]
    misread = lab + np.array([30.0, 40.0, -40.0])

    found = correct(Target(ANGLES, lab), [Attempt(silver, lab, misread)])

    assert found.parts == silver
    assert found.mean_difference == pytest.approx(0.0, abs=1e-9)
