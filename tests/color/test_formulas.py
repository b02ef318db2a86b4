from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import FORMULAS, ciede2000, din6175

STANDARD = np.array([[60.0, 30, -20], [40, 5, 5], [20, -3, 9]])
SAMPLE = STANDARD + np.array([1.0, 2.0, -1.5])
ANGLES = [15, 45, 110]


def test_registry_offers_the_six_formulas():
    ids = {"cie76", "cie94", "ciede2000", "cmc", "din99", "din6175"}

    assert set(FORMULAS) == ids
    assert all(formula.id == key for key, formula in FORMULAS.items())


@pytest.mark.parametrize("formula", FORMULAS.values(), ids=list(FORMULAS))
def test_symmetry_flag_tells_the_truth(formula):
    forth = formula(STANDARD, SAMPLE, ANGLES)
    back = formula(SAMPLE, STANDARD, ANGLES)

    assert np.allclose(forth, back, rtol=1e-9) == formula.symmetric


@pytest.mark.parametrize("formula", FORMULAS.values(), ids=list(FORMULAS))
def test_angle_flag_tells_the_truth(formula):
    here = formula(STANDARD, SAMPLE, ANGLES)
    elsewhere = formula(STANDARD, SAMPLE, [25, 75, 90])

    assert np.array_equal(here, elsewhere) != formula.needs_angle


def test_registry_calls_the_named_function():
    by_name = FORMULAS["ciede2000"](STANDARD, SAMPLE, ANGLES)
    by_angle = FORMULAS["din6175"](STANDARD, SAMPLE, ANGLES)

    assert by_name.tolist() == ciede2000(STANDARD, SAMPLE).tolist()
    assert by_angle.tolist() == din6175(STANDARD, SAMPLE, ANGLES).tolist()


def test_only_din6175_is_experimental():
    experimental = [formula for formula in FORMULAS.values() if formula.experimental]

    assert [formula.id for formula in experimental] == ["din6175"]
    assert "experimental" in experimental[0].label
