"""Baked light times fitted paint against the slow way."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import groupby
from operator import itemgetter
from pathlib import Path

import numpy as np
import pytest

from paintlink.color import drawing_curve
from paintlink.library import bundled, paint_spec
from paintlink.model import ColorSpec, FloatArray
from paintlink.preview import bake, basis, disc, environment, store
from tests.preview import truth

DATA = Path(__file__).parents[3] / "shared/data"
REAL = DATA / "real_paints_5angle.csv"
CURVES = DATA / "real_paints_curves.csv"
NORMALS = truth.visible_normals(240, seed=1)
THREE_ANGLES = [truth.RED, truth.SILVER, truth.PEARL, *truth.effect_paints(20, seed=5)]
FIVE_ANGLES = [
    truth.as_five_angles(spec, seed) for seed, spec in enumerate(THREE_ANGLES[1:])
]
SHEET_SILVER = truth.sheet_curve(truth.SILVER)
WORST = {"studio": 0.3, "sky": 0.5}


@cache
def arriving(light: str) -> FloatArray:
    return truth.arriving(environment.load(light).radiance, NORMALS)


@cache
def arriving_beyond(light: str) -> FloatArray:
    return truth.arriving_beyond(environment.load(light).radiance, NORMALS)


def true_colours(light: str, spec: ColorSpec) -> FloatArray:
    return true_of(light, spec.angles_deg, spec.lab())


def true_of(
    light: str, angles_deg: Sequence[float], measured: FloatArray
) -> FloatArray:
    lab = drawing_curve(angles_deg, measured)(truth.BIN_DEG)
    lab[:, 0] = np.maximum(lab[:, 0], 0)
    seen = truth.seen(arriving(light), truth.rgb_from_lab(lab))
    if angles_deg[0] == -15:
        far, near = truth.rgb_from_lab(np.maximum(measured[:2], [0, -999, -999]))
        seen = seen + arriving_beyond(light) * (far - near) / np.pi
    return seen


def drawn_colours(light: str, spec: ColorSpec) -> FloatArray:
    return drawn_of(light, basis.coefficients([spec])[0])


def drawn_of(light: str, paint: FloatArray) -> FloatArray:
    table = store.base_table(environment.load(light), None)
    channels = environment.load(light).channels
    terms = disc.look_up(table, NORMALS.astype(np.float32))
    by_channel = terms.reshape(len(NORMALS), channels, -1)
    spread = np.broadcast_to(by_channel, (len(NORMALS), 3, by_channel.shape[2]))
    return np.einsum("nck,kc->nc", spread, paint)


@pytest.mark.parametrize("light", ["studio", "sky"])
@pytest.mark.parametrize(
    "paints", [THREE_ANGLES, FIVE_ANGLES], ids=["three angles", "five angles"]
)
def test_pictures_are_within_the_colour_goals(
    light: str, paints: list[ColorSpec]
) -> None:
    assert_goals(light, errors_of(light, paints))


def errors_of(light: str, paints: Sequence[ColorSpec]) -> FloatArray:
    return np.array([
        truth.difference(true_colours(light, spec), drawn_colours(light, spec))
        for spec in paints
    ])


def assert_goals(light: str, errors: FloatArray) -> None:
    assert errors.mean() <= 0.02
    assert errors.max() <= WORST.get(light, WORST["sky"])


def library_effects(count: int) -> list[ColorSpec]:
    table = bundled()
    rows = [row for row, kind in enumerate(table.finishes) if kind != "solid"]
    return [paint_spec(table, row) for row in rows[:: len(rows) // count]]


@pytest.mark.parametrize("light", ["studio", "sky"])
def test_effect_colours_of_the_library_are_within_the_goals(light: str) -> None:
    assert_goals(light, errors_of(light, library_effects(60)))


@pytest.mark.proof
@pytest.mark.timeout(600)
@pytest.mark.parametrize("light", ["studio", "sky"])
def test_every_effect_colour_of_the_library_is_within_the_goals(light: str) -> None:
    assert_goals(light, errors_of(light, library_effects(3000)))


@pytest.mark.parametrize("light", ["studio", "sky"])
@pytest.mark.skipif(not REAL.exists(), reason="needs ../shared/data")
def test_real_paints_are_within_the_goals(light: str) -> None:
    with REAL.open(newline="") as file:
        paints = [_real_paint(row) for row in csv.DictReader(file)]

    assert_goals(light, errors_of(light, paints))


def _real_paint(row: dict[str, str]) -> ColorSpec:
    angles = (15, 25, 45, 75, 110)
    labs = [[float(row[f"{channel}{angle}"]) for channel in "Lab"] for angle in angles]
    return truth.paint(*labs, angles=angles)


@pytest.mark.parametrize("light", ["studio", "sky"])
@pytest.mark.skipif(not CURVES.exists(), reason="needs ../shared/data")
def test_real_paints_at_21_angles_are_within_the_goals(light: str) -> None:
    errors = [
        truth.difference(
            true_of(light, angles, lab),
            drawn_of(light, basis.coefficients_of(angles, [lab])[0]),
        )
        for angles, lab in _real_curves()
    ]

    assert_goals(light, np.array(errors))


def _real_curves() -> Iterator[tuple[tuple[float, ...], FloatArray]]:
    """Angles and Lab of each material, from -15 on."""
    with CURVES.open(newline="") as file:
        rows = list(csv.DictReader(file))
    for _, material in groupby(rows, key=itemgetter("material")):
        lines = [[float(row[key]) for key in ("aspecular", *"Lab")] for row in material]
        lines.sort()
        yield tuple(line[0] for line in lines), np.array(lines)[:, 1:]


def test_fitting_many_equals_fitting_each() -> None:
    together = basis.coefficients(THREE_ANGLES)

    alone = [basis.coefficients([spec])[0] for spec in THREE_ANGLES]
    np.testing.assert_allclose(together, alone, atol=1e-9)


def test_baked_light_gives_the_published_radiance() -> None:
    studio = environment.Environment("sheet", "Sheet", truth.sheet_studio)
    table = bake.base_table(studio)
    normals = np.array([[0, 0, 1], [0.6, 0, 0.8]], dtype=np.float32)
    theta = np.minimum(basis.THETA_DEG, 110.0)
    lab = np.stack([np.interp(theta, truth.BIN_DEG, y) for y in SHEET_SILVER.T], axis=1)

    fitted = basis.fit(truth.rgb_from_lab(lab))

    seen = disc.look_up(table, normals)[:, : len(fitted)] @ fitted
    published = [(0.09659, 0.13144, 0.17747), (0.10333, 0.14067, 0.18998)]
    assert truth.difference(seen, np.array(published)).max() < 0.02


def test_solid_paint_reflects_the_same_at_every_angle() -> None:
    (factors,) = basis.reflectance(truth.RED.angles_deg, truth.RED.lab()[None])

    np.testing.assert_allclose(factors, factors[:1].repeat(len(factors), 0), atol=1e-9)


def test_other_observer_keeps_neutrals_neutral() -> None:
    grey = truth.GREY

    red, green, blue = basis.reflectance(grey.angles_deg, grey.lab()[None], "2")[0, 0]

    assert red == pytest.approx(green, abs=1e-6)
    assert blue == pytest.approx(green, abs=1e-6)
