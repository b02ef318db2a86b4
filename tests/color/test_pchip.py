from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from paintlink.color import fit

SIX = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
SETS = [SIX, SIX[1:], (15.0, 45.0, 110.0)]

channel = st.floats(-100.0, 150.0)


def paints(count: int, angles: int) -> np.ndarray:
    lab = np.random.default_rng(angles).uniform(-60, 140, (count, angles, 3))
    # Level pieces and turning points take the branches that smooth data never take.
    lab[: count // 4, 1] = lab[: count // 4, 0]
    lab[count // 4 : count // 2] = np.sort(lab[count // 4 : count // 2], axis=1)
    return lab


@pytest.mark.parametrize("angles", SETS, ids=len)
def test_curve_agrees_with_scipy(angles):
    interpolate = pytest.importorskip("scipy.interpolate")
    lab = paints(80, len(angles))
    asked = np.linspace(angles[0], angles[-1], 173)

    ours = fit(angles, lab, "pchip")(asked)
    theirs = interpolate.PchipInterpolator(angles, lab, axis=1)(asked)

    assert ours == pytest.approx(theirs, abs=1e-10)


@given(arrays(np.float64, (2, 6, 3), elements=channel))
def test_curve_passes_through_all_points(lab):
    assert fit(SIX, lab, "pchip")(SIX) == pytest.approx(lab, abs=1e-10)


@given(arrays(np.float64, (6, 3), elements=channel))
def test_curve_stays_between_its_neighbours(lab):
    curve = fit(SIX, lab, "pchip")

    for i in range(5):
        values = curve(np.linspace(SIX[i], SIX[i + 1], 20))
        low, high = np.sort(lab[i : i + 2], axis=0)
        assert (values >= low - 1e-9).all()
        assert (values <= high + 1e-9).all()


def test_curve_holds_the_measured_ends():
    lab = paints(1, 6)[0]

    values = fit(SIX, lab, "pchip")([-90, -15, 110, 180])

    assert values == pytest.approx(lab[[0, 0, -1, -1]], abs=1e-12)


def test_answer_takes_shape_of_question():
    curve = fit(SIX, paints(7, 6), "pchip")

    assert curve(30.0).shape == (7, 3)
    assert curve(np.zeros((4, 5))).shape == (7, 4, 5, 3)
    assert (curve.model, curve.angles_deg) == ("pchip", SIX)
