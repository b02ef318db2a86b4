from __future__ import annotations

import numpy as np
import pytest

from paintlink.preview import coat, disc, environment
from tests.preview import truth


def test_fresnel_at_normal_incidence_is_four_percent() -> None:
    assert coat.fresnel(np.array([1.0])) == pytest.approx(0.04)
    assert coat.fresnel(np.array([0.0])) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("roughness", "mean", "worst"),
    [(0.002, 0.03, 1.0), (0.01, 0.03, 1.0), (0.03, 0.06, 1.0), (0.1, 0.03, 1.0)],
)
def test_coat_over_metallic_is_near_the_full_integral(
    roughness: float, mean: float, worst: float
) -> None:
    light = environment.load("studio")
    normals = truth.visible_normals(100, seed=2)
    normals = normals[normals[:, 2] > 0.1]

    table = coat.coat_table(light, roughness)

    drawn = disc.look_up(table, normals.astype(np.float32)).repeat(3, axis=1)
    true = truth.coat_seen(light.radiance, normals, roughness)
    base = np.array([0.10, 0.13, 0.18])
    error = truth.difference(base + drawn, base + true)
    assert error.mean() < mean
    assert error.max() < worst


def test_rougher_coats_spread_the_same_light() -> None:
    light = environment.load("studio")
    facing = truth.visible_normals(400, seed=3)
    facing = facing[facing[:, 2] > 0.6].astype(np.float32)

    sharp, dull = (
        disc.look_up(coat.coat_table(light, roughness), facing)
        for roughness in (0.002, 0.2)
    )

    assert sharp.max() > 2 * dull.max()
    assert sharp.mean() == pytest.approx(dull.mean(), rel=0.35)
