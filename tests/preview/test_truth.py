"""The slow way reproduces the published numbers, so it may judge the fast one."""

from __future__ import annotations

import numpy as np
import pytest

from paintlink.preview.lights import sky
from tests.preview import truth

NORMALS = np.array([[0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8], [-0.48, -0.64, 0.6]])
LIGHTS = {"studio": truth.sheet_studio, "sky": sky.radiance}
PAINTS = {"red": truth.RED, "silver": truth.SILVER, "pearl": truth.PEARL}

RADIANCE = {
    ("studio", "red"): [
        (0.28892, 0.01622, 0.01610),
        (0.29683, 0.01667, 0.01654),
        (0.47859, 0.02687, 0.02667),
        (0.13922, 0.00782, 0.00776),
    ],
    ("studio", "silver"): [
        (0.09659, 0.13144, 0.17747),
        (0.10333, 0.14067, 0.18998),
        (0.25672, 0.33726, 0.43916),
        (0.03386, 0.04692, 0.06460),
    ],
    ("studio", "pearl"): [
        (0.21128, 0.12850, 0.08768),
        (0.22289, 0.13888, 0.09186),
        (0.41977, 0.32836, 0.16432),
        (0.08404, 0.04379, 0.04339),
    ],
    ("sky", "red"): [
        (0.36602, 0.02066, 0.02210),
        (0.43855, 0.02441, 0.02533),
        (0.48571, 0.02814, 0.03139),
        (0.09454, 0.00534, 0.00601),
    ],
    ("sky", "silver"): [
        (0.14089, 0.19721, 0.30003),
        (0.15452, 0.21298, 0.31022),
        (0.22371, 0.32009, 0.49733),
        (0.02754, 0.03345, 0.04314),
    ],
    ("sky", "pearl"): [
        (0.28566, 0.19234, 0.12638),
        (0.33795, 0.21120, 0.14359),
        (0.41580, 0.31625, 0.18969),
        (0.05543, 0.02970, 0.03692),
    ],
}


@pytest.mark.parametrize(
    ("light", "expected"), [("studio", 1.913197), ("sky", 1.731235)]
)
def test_exposure_is_the_published_one(light: str, expected: float) -> None:
    assert truth.normalisation(LIGHTS[light]) == pytest.approx(expected, abs=2e-6)


@pytest.mark.parametrize("light", LIGHTS)
def test_quadrature_reproduces_the_published_radiances(light: str) -> None:
    by_angle = truth.arriving(LIGHTS[light], NORMALS)

    for name, spec in PAINTS.items():
        factors = truth.rgb_from_lab(truth.sheet_curve(spec))
        np.testing.assert_allclose(
            truth.seen(by_angle, factors), RADIANCE[light, name], atol=2e-5, rtol=1e-4
        )
