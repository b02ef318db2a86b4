from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import reflectance_to_lab
from paintlink_simulators.colornet import BundledBook, Target, formulate
from paintlink_simulators.paint import (
    EXACT_SITE,
    WAVELENGTHS_NM,
    SprayBooth,
    book,
)

ANGLES_DEG = np.array([15.0, 45.0, 110.0])


def aged(code: str, seed: int) -> Target:
    """The colour of a bundled paint whose toners have lost or gained some strength."""
    rng = np.random.default_rng(seed)
    formula = {t: parts * rng.lognormal(0.0, 0.1) for t, parts in book()[code].items()}
    panel = SprayBooth(EXACT_SITE, seed=1).spray(formula)
    factors = panel.factors_at(ANGLES_DEG)
    return Target(ANGLES_DEG, reflectance_to_lab(WAVELENGTHS_NM, factors))


def test_named_paint_comes_first_then_the_nearest() -> None:
    starts = BundledBook().starts("BM304", aged("YM144", 1))

    assert starts[0] == book()["BM304"]
    assert book()["YM144"] in starts[1:]
    assert len(starts) == 3


def test_paints_of_other_libraries_start_from_the_nearest() -> None:
    starts = BundledBook().starts("SHOP-1", aged("GM044", 2))

    assert book()["GM044"] in starts
    assert len({tuple(one.items()) for one in starts}) == 3


@pytest.mark.parametrize("code", ["YM144", "GM044", "BM304", "RM209", "GS196", "MM200"])
def test_aged_bundled_paints_get_a_formula(code: str) -> None:
    target = aged(code, 3)

    found = formulate(target, BundledBook().starts(code, target))

    assert found.mean_difference < 0.5
