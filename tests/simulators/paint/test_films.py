"""Thin films against theory and against colour-science."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from paintlink.color import lab_to_lch, reflectance_to_lab
from paintlink_simulators.paint.films import Film, response
from paintlink_simulators.paint.flakes import FLAKES, MICA_NM
from paintlink_simulators.paint.materials import refractive_index
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM

CLEAR = {"titania", "mica", "silica"}
LOSSLESS = [
    flake for flake in FLAKES if {film.material for film in flake.films} <= CLEAR
]
INCIDENCES = np.radians([0.0, 4.0, 14.0, 24.0, 32.0])


def coated_mica(thickness_nm: float) -> list[Film]:
    coat = Film("titania", (thickness_nm,))
    return [coat, Film("mica", MICA_NM), coat]


def hue_deg(thickness_nm: float, incidence_deg: float) -> float:
    seen = response(coated_mica(thickness_nm), np.radians(incidence_deg)).reflectance
    return float(lab_to_lch(reflectance_to_lab(WAVELENGTHS_NM, seen[0]))[2])


@pytest.mark.parametrize("flake", LOSSLESS, ids=lambda flake: flake.code)
def test_clear_films_lose_no_light(flake) -> None:
    seen = response(flake.films, INCIDENCES)

    assert np.abs(seen.reflectance + seen.transmittance - 1.0).max() < 1e-14


def test_metal_flakes_let_nothing_through_and_reflect_most() -> None:
    seen = response(FLAKES[0].films, INCIDENCES)

    assert seen.transmittance.max() < 1e-6
    assert seen.reflectance[:, 15] == pytest.approx(0.88, abs=0.01)


@pytest.mark.parametrize("flake", FLAKES, ids=lambda flake: flake.code)
def test_no_film_creates_light(flake) -> None:
    seen = response(flake.films, INCIDENCES)

    assert seen.reflectance.min() >= 0.0
    assert (seen.reflectance + seen.transmittance).max() <= 1.0 + 1e-12


@pytest.mark.parametrize("flake", FLAKES, ids=lambda flake: flake.code)
def test_films_agree_with_colour_science_at_normal_incidence(flake) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from colour.phenomena import multilayer_tmm
    binder = refractive_index("binder")
    indices = [binder, *(refractive_index(f.material) for f in flake.films), binder]
    counts = max(len(film.thicknesses_nm) for film in flake.films)

    expected = np.mean(
        [
            multilayer_tmm(
                np.array(indices),
                np.array([
                    f.thicknesses_nm[i % len(f.thicknesses_nm)] for f in flake.films
                ]),
                WAVELENGTHS_NM,
                0.0,
            )[0].mean(axis=-1)
            for i in range(counts)
        ],
        axis=0,
    )

    seen = response(flake.films, 0.0).reflectance[0]
    assert np.abs(seen - np.ravel(expected)).max() < 1e-12


def test_one_thin_film_is_the_airy_formula() -> None:
    """At oblique incidence, where colour-science is no oracle for dispersive layers."""
    incidence, thickness = np.radians(28.0), 117.0
    n0, n1 = refractive_index("binder").real, refractive_index("titania").real
    cos0, cos1 = np.cos(incidence), np.sqrt(1 - (n0 / n1 * np.sin(incidence)) ** 2)
    phase = 4 * np.pi * n1 * thickness * cos1 / WAVELENGTHS_NM
    reflected = []
    for r in (
        (n0 * cos0 - n1 * cos1) / (n0 * cos0 + n1 * cos1),
        (n1 * cos0 - n0 * cos1) / (n1 * cos0 + n0 * cos1),
    ):
        finesse = 4 * r**2 / (1 - r**2) ** 2 * np.sin(phase / 2) ** 2
        reflected.append(finesse / (1 + finesse))

    seen = response([Film("titania", (thickness,))], incidence).reflectance[0]

    assert seen == pytest.approx(np.mean(reflected, axis=0), abs=1e-12)


@pytest.mark.parametrize("incidence_deg", [4.0, 14.0, 24.0, 32.0])
def test_thicker_layers_walk_down_the_hue_circle(incidence_deg: float) -> None:
    """Yellow at 80 nm, then red, violet, blue and green at 160 nm."""
    hues = [hue_deg(nm, incidence_deg) for nm in range(80, 161, 4)]

    turned = np.unwrap(hues, period=360.0)
    assert np.all(np.diff(turned) < 0.0)
    assert turned[0] - turned[-1] == pytest.approx(310.0, abs=25.0)


@pytest.mark.parametrize("thickness_nm", [100.0, 110.0, 120.0, 140.0, 150.0, 160.0])
def test_steeper_light_sees_a_thinner_film(thickness_nm: float) -> None:
    hues = np.unwrap([hue_deg(thickness_nm, d) for d in (4, 14, 24, 32)], period=360.0)

    assert np.all(np.diff(hues) > 0.0)


@pytest.mark.parametrize(
    ("thickness_nm", "hue", "chroma"),
    [(80, 87, 48), (100, 332, 51), (110, 309, 74), (120, 279, 57), (150, 169, 35)],
)
def test_titania_on_mica_has_the_colours_of_the_trade(
    thickness_nm: float, hue: float, chroma: float
) -> None:
    seen = response(coated_mica(thickness_nm), np.radians(14.0)).reflectance[0]

    _, found_chroma, found_hue = lab_to_lch(reflectance_to_lab(WAVELENGTHS_NM, seen))
    assert found_hue == pytest.approx(hue, abs=1.0)
    assert found_chroma == pytest.approx(chroma, abs=1.0)


def test_silver_white_mica_is_nearly_neutral() -> None:
    seen = response(coated_mica(50.0), np.radians(14.0)).reflectance[0]

    assert lab_to_lch(reflectance_to_lab(WAVELENGTHS_NM, seen))[1] < 8.0


def test_refractive_indices_are_the_published_ones() -> None:
    rutile = refractive_index("rutile").real

    assert rutile[[5, 15, 25]] == pytest.approx([2.81, 2.65, 2.57], abs=0.005)
    assert refractive_index("titania").real[[5, 15, 25]] == pytest.approx(
        [2.65, 2.50, 2.43], abs=0.01
    )
    assert refractive_index("silica").real[15] == pytest.approx(1.4599, abs=1e-4)
