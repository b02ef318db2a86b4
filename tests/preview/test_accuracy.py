"""Baked light times fitted paint against the slow way."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from paintlink.color import drawing_curve
from paintlink.model import ColorSpec, FloatArray
from paintlink.preview import basis, disc, environment, light_names, store
from tests.preview import truth

NORMALS = truth.visible_normals(240, seed=1)
THREE_ANGLES = [truth.RED, truth.SILVER, truth.PEARL, *truth.effect_paints(20, seed=5)]
FIVE_ANGLES = [
    truth.as_five_angles(spec, seed) for seed, spec in enumerate(THREE_ANGLES[1:])
]
WORST = {"studio": 0.3, "sky": 0.5}


@cache
def arriving(light: str) -> FloatArray:
    return truth.arriving(environment.load(light).radiance, NORMALS)


def true_colours(light: str, spec: ColorSpec) -> FloatArray:
    lab = drawing_curve(spec.angles_deg, spec.lab())(truth.BIN_DEG)
    lab[:, 0] = np.maximum(lab[:, 0], 0)
    return truth.seen(arriving(light), truth.rgb_from_lab(lab))


def drawn_colours(light: str, spec: ColorSpec) -> FloatArray:
    table = store.base_table(light, None)
    channels = environment.load(light).channels
    terms = disc.look_up(table, NORMALS.astype(np.float32))
    by_channel = terms.reshape(len(NORMALS), channels, -1)
    spread = np.broadcast_to(by_channel, (len(NORMALS), 3, by_channel.shape[2]))
    return np.einsum("nck,kc->nc", spread, basis.coefficients([spec])[0])


@pytest.mark.parametrize("light", light_names())
@pytest.mark.parametrize(
    "paints", [THREE_ANGLES, FIVE_ANGLES], ids=["three angles", "five angles"]
)
def test_pictures_are_within_the_colour_goals(
    light: str, paints: list[ColorSpec]
) -> None:
    errors = np.array([
        truth.difference(true_colours(light, spec), drawn_colours(light, spec))
        for spec in paints
    ])

    assert errors.mean() <= 0.02
    assert errors.max() <= WORST[light]


def test_fit_reproduces_the_published_coefficients(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(basis, "TERMS", 8)
    lab = truth.sheet_curve(truth.SILVER)[:: len(truth.BIN_DEG) // 720]

    fitted = basis.fit(truth.rgb_from_lab(lab))

    published = [
        (0.167406, 0.201649, 0.238484),
        (-0.265259, -0.308257, -0.347449),
        (0.155869, 0.175173, 0.188855),
        (-0.063462, -0.068321, -0.069106),
        (0.018496, 0.018956, 0.017680),
        (-0.003684, -0.003657, -0.003240),
        (0.000182, 0.000065, -0.000158),
        (0.000068, 0.000113, 0.000185),
    ]
    np.testing.assert_allclose(fitted, published, atol=2e-6)


def test_fitting_many_equals_fitting_each() -> None:
    together = basis.coefficients(THREE_ANGLES)

    alone = [basis.coefficients([spec])[0] for spec in THREE_ANGLES]
    np.testing.assert_allclose(together, alone, atol=1e-9)


def test_baked_light_matches_the_published_integrals() -> None:
    studio = environment.Environment("sheet", "Sheet", truth.sheet_studio)

    table = basis_table_of(studio)

    published = [1.772493, -0.043150, -1.460893, -0.012427, 0.863115, 0.150405]
    np.testing.assert_allclose(table[0, :6], published, atol=3e-3)
    published = [1.820989, -0.088201, -1.456125, 0.239181, 0.895057, -0.204931]
    np.testing.assert_allclose(table[1, :6], published, atol=3e-3)


def basis_table_of(light: environment.Environment) -> FloatArray:
    from paintlink.preview import bake

    normals = np.array([[0, 0, 1], [0.6, 0, 0.8]], dtype=np.float32)
    return disc.look_up(bake.base_table(light), normals)


def test_solid_paint_reflects_the_same_at_every_angle() -> None:
    factors = basis.reflectance(truth.RED)

    np.testing.assert_allclose(factors, factors[:1].repeat(len(factors), 0), atol=1e-9)


def test_other_observer_keeps_neutrals_neutral() -> None:
    grey = ColorSpec("grey", truth.GREY.samples, observer="2")

    red, green, blue = basis.reflectance(grey)[0]

    assert red == pytest.approx(green, abs=1e-6)
    assert blue == pytest.approx(green, abs=1e-6)
