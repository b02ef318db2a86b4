"""Suggestions and labels, held against the formulation stand-in itself."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.library import book, bundled
from paintlink.model import FloatArray
from paintlink.snap import forecast, nearest
from paintlink.snap.makeable import data
from paintlink_simulators.colornet import Target, formulate
from paintlink_simulators.paint import Formula
from tests.snap.conftest import STANDARD, make_target

STARTS = 4
MAKEABLE_DE00 = 1.0


def formulas_near(lab: FloatArray) -> list[Formula]:
    """Formulas of the nearest paints of the book, as ColorNet would get them."""
    table = bundled()
    matches = nearest(make_target(lab), table, top=STARTS)
    rows = np.searchsorted(table.ids, [match.paint_id for match in matches])
    return [{one.code: one.parts for one in book().formula(int(row))} for row in rows]


def makeable(lab: FloatArray) -> bool:
    """Whether the stand-in finds a formula for a colour from the book's paints."""
    target = Target(np.array(STANDARD), lab)
    for start in formulas_near(lab):
        try:
            found = formulate(target, [start])
        except InputError:
            continue
        if found.mean_difference <= MAKEABLE_DE00:
            return True
    return False


def labels() -> tuple[FloatArray, FloatArray]:
    """Colours that were never learned from, and their residuals."""
    with np.load(data.FOLDER / data.LABELS) as archive:
        lab = archive["lab_hundredths"].astype(float) / 100.0
        residual = archive["residual_thousandths"] / 1000.0
    unseen = (np.arange(len(lab)) // 2) % 2 == 1
    return lab[unseen], residual[unseen]


def share_that_works(count: int, seed: int) -> float:
    lab, residual = labels()
    bad = np.flatnonzero(residual > MAKEABLE_DE00)
    chosen = np.random.default_rng(seed).choice(bad, count, replace=False)
    return float(
        np.mean([makeable(forecast(make_target(lab[i])).suggestion) for i in chosen])
    )


def test_suggestions_for_a_few_bad_designs_can_be_made() -> None:
    assert share_that_works(8, 1) >= 0.85


@pytest.mark.proof
@pytest.mark.timeout(900)
def test_suggestions_for_bad_designs_can_be_made() -> None:
    assert share_that_works(200, 2) >= 0.95


@pytest.mark.proof
@pytest.mark.timeout(900)
def test_stored_labels_are_what_the_stand_in_says() -> None:
    lab, residual = labels()
    chosen = np.random.default_rng(3).choice(len(lab), 60, replace=False)

    again = [makeable(lab[i]) for i in chosen]

    # Other starting formulas find a formula a little more or less often.
    agreed = np.mean(np.array(again) == (residual[chosen] <= MAKEABLE_DE00))
    assert agreed >= 0.9
