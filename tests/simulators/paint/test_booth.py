from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import ciede2000, reflectance_to_lab
from paintlink.errors import InputError
from paintlink_simulators.paint import (
    BODY_SHOP_SITE,
    CAREFUL_SITE,
    EXACT_SITE,
    WAVELENGTHS_NM,
    Panel,
    SprayBooth,
    amounts,
    noisy,
    reflect,
)
from paintlink_simulators.paint.variation import PAINTER
from tests.simulators.paint.conftest import ANGLES_DEG

SILVER = {"A02": 55.0, "A06": 12.0, "W12": 4.0, "N20": 0.8}
RED = {"R51": 60.0, "W10": 8.0, "O40": 12.0}


def lab(panel: Panel) -> np.ndarray:
    return reflectance_to_lab(WAVELENGTHS_NM, panel.factors_at(ANGLES_DEG))


def spread(panels: list[Panel]) -> float:
    """Median CIEDE2000 between successive panels, at 15 degrees."""
    labs = np.array([lab(panel)[1] for panel in panels])
    return float(np.median(ciede2000(labs[1:], labs[:-1])))


def test_exact_site_sprays_what_the_model_says() -> None:
    panel = SprayBooth(EXACT_SITE, seed=1).spray(SILVER, "silver")

    expected = reflect(amounts([SILVER]), ANGLES_DEG)[0]
    assert panel.factors_at(ANGLES_DEG) == pytest.approx(expected, rel=1e-12)
    assert panel.name == "silver"


def test_two_panels_of_one_formula_differ() -> None:
    booth = SprayBooth(CAREFUL_SITE, seed=1)

    first, second = (lab(booth.spray(SILVER)) for _ in range(2))

    assert ciede2000(first, second).max() > 0.05


def test_body_shop_sprays_less_evenly_than_a_careful_painter() -> None:
    careful, shop = (
        spread([booth.spray(SILVER) for _ in range(150)])
        for booth in (
            SprayBooth(CAREFUL_SITE, seed=2),
            SprayBooth(BODY_SHOP_SITE, seed=2),
        )
    )

    assert 0.3 < careful < 2.0
    assert 1.6 < shop / careful < 2.4


def test_spraying_shows_most_near_the_mirror_direction() -> None:
    """Save near 25 degrees, where the lobes of this silver cross."""
    booth = SprayBooth(replace(EXACT_SITE, application=PAINTER), seed=10)
    exact = lab(SprayBooth(EXACT_SITE, seed=0).spray(SILVER))

    away = ciede2000(exact, np.array([lab(booth.spray(SILVER)) for _ in range(120)]))

    medians = np.median(away, axis=0)
    assert np.all(np.diff(medians[[1, 3, 4, 5]]) < 0.0)
    assert 0.2 < medians[1] < 1.0


def test_spraying_does_not_move_solids() -> None:
    """They have no flakes to tilt; only the scales differ between their panels."""
    booth = SprayBooth(CAREFUL_SITE, seed=3)

    labs = np.array([lab(booth.spray(RED))[1] for _ in range(30)])

    assert ciede2000(labs, labs.mean(axis=0)).max() < 0.3


def test_a_site_keeps_its_toner_strengths() -> None:
    means = [
        np.mean([lab(booth.spray(RED))[0] for _ in range(40)], axis=0)
        for seed in (4, 5)
        for booth in [SprayBooth(CAREFUL_SITE, seed=seed)]
    ]

    # Far more than the scales leave after 40 panels.
    assert ciede2000(means[0], means[1]) > 0.1


def test_same_seed_sprays_the_same_panels() -> None:
    first, second = (SprayBooth(CAREFUL_SITE, seed=6) for _ in range(2))

    for _ in range(3):
        assert (first.spray(SILVER).factors == second.spray(SILVER).factors).all()


def test_panel_carries_gloss_and_texture() -> None:
    panel = SprayBooth(CAREFUL_SITE, seed=7).spray(SILVER)

    assert panel.gloss_gu is not None
    assert 80.0 < panel.gloss_gu < 104.0
    names = [(one.name, one.angle_deg) for one in panel.texture]
    assert names == [
        ("sparkle intensity", 15.0),
        ("sparkle intensity", 45.0),
        ("sparkle intensity", 75.0),
        ("graininess", None),
    ]
    assert all(one.value > 0.0 for one in panel.texture)


def test_coarse_flakes_sparkle_more_and_solids_not_at_all() -> None:
    booth = SprayBooth(EXACT_SITE, seed=8)

    coarse, fine, solid = (
        [one.value for one in booth.spray(formula).texture]
        for formula in ({"A01": 60.0, "N20": 1.0}, {"A08": 60.0, "N20": 1.0}, RED)
    )

    assert np.all(np.array(coarse) > np.array(fine))
    assert solid == [0.0] * 4


def test_reading_a_sprayed_panel_keeps_what_the_panel_is() -> None:
    panel = SprayBooth(CAREFUL_SITE, seed=9).spray(SILVER, "silver")

    reading = noisy(panel, np.random.default_rng(1), CAREFUL_SITE.reading)

    assert (reading.name, reading.texture) == ("silver", panel.texture)
    assert 0.0 < np.abs(reading.factors - panel.factors).max() < 0.1


def test_formula_of_another_system_is_refused() -> None:
    with pytest.raises(InputError, match="no toner '9401'"):
        SprayBooth(seed=1).spray({"9401": 10.0})
