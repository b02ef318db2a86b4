from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import ciede2000, reflectance_to_lab
from paintlink.errors import InputError
from paintlink_simulators.colornet import Target
from paintlink_simulators.paint import WAVELENGTHS_NM, amounts, reflect

ANGLES = np.array([15.0, 45.0, 110.0])
LAB = np.array([[52.0, 58.0, 40.0], [34.0, 48.0, 30.0], [20.0, 34.0, 20.0]])
RED = {"R52": 60.0, "A03": 30.0, "N20": 10.0}


def test_prediction_is_the_lab_of_the_model():
    lab = Target(ANGLES, LAB).predicted(amounts([RED]))

    factors = reflect(amounts([RED]), ANGLES)[0]
    np.testing.assert_array_equal(lab[0], reflectance_to_lab(WAVELENGTHS_NM, factors))


def test_prediction_keeps_to_the_observer_of_the_target():
    two = Target(ANGLES, LAB, "2").predicted(amounts([RED]))
    ten = Target(ANGLES, LAB, "10").predicted(amounts([RED]))

    assert np.abs(two - ten).max() > 0.5


def test_mean_difference_is_the_mean_of_the_angles():
    other = LAB + np.array([1.0, -2.0, 0.5])

    target = Target(ANGLES, LAB)

    expected = ciede2000(LAB, other)
    np.testing.assert_allclose(target.difference(other), expected, atol=1e-12)
    assert target.mean_difference(other) == pytest.approx(expected.mean())


@pytest.mark.parametrize("step", np.eye(3), ids=["L", "a", "b"])
def test_misfit_of_small_steps_is_near_ciede2000(step):
    small = LAB + 0.1 * step

    target = Target(ANGLES, LAB)

    length = np.linalg.norm(target.misfit(small).reshape(3, 3), axis=1)
    np.testing.assert_allclose(length, target.difference(small), rtol=0.35)


def test_misfit_has_no_seam_at_hue_zero():
    below = Target(ANGLES, np.array([[50.0, 40.0, -1e-6]] * 3))
    above = Target(ANGLES, np.array([[50.0, 40.0, 1e-6]] * 3))

    np.testing.assert_allclose(below.misfit(LAB), above.misfit(LAB), atol=1e-4)


@pytest.mark.parametrize(
    ("angles", "lab", "message"),
    [
        ([15.0, 45.0], LAB, "needs L, a, b at each angle"),
        ([], np.zeros((0, 3)), "needs L, a, b at each angle"),
        (ANGLES, LAB + np.nan, "finite angles and Lab values: measure it again"),
    ],
)
def test_impossible_targets_are_refused(angles, lab, message):
    with pytest.raises(InputError, match=message):
        Target(np.array(angles), lab)
