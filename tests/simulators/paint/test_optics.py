from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink_simulators.paint.optics import COAT_INDEX, rays, transmission

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)


def test_flakes_that_instruments_see_lean_little() -> None:
    seen = rays(ANGLES_DEG)

    tilts = np.degrees(seen.tilt_rad)
    incidences = np.degrees(seen.incidence_rad)
    assert tilts == pytest.approx([-3.57, 4.33, 7.47, 14.06, 23.80, 32.65], abs=0.006)
    assert incidences == pytest.approx(
        [31.70, 23.80, 20.65, 14.06, 4.33, 4.52], abs=0.006
    )


def test_surface_lets_through_what_fresnel_says() -> None:
    assert transmission(0.0) == pytest.approx(1.0 - (0.5 / 2.5) ** 2)
    assert transmission(45.0) == pytest.approx(0.94976, abs=1e-5)
    assert rays(ANGLES_DEG).transmission == pytest.approx(
        [0.87, 0.91, 0.91, 0.91, 0.91, 0.84], abs=0.006
    )


def test_parallel_light_passes_unhindered_at_the_brewster_angle() -> None:
    brewster = np.degrees(np.arctan(COAT_INDEX))

    # Only the perpendicular half is reflected there: ((1 − n²)/(1 + n²))².
    reflected = ((1 - COAT_INDEX**2) / (1 + COAT_INDEX**2)) ** 2 / 2
    assert transmission(brewster) == pytest.approx(1 - reflected)


def test_mirror_direction_is_seen_by_flat_flakes() -> None:
    seen = rays(0.0)

    assert seen.tilt_rad == pytest.approx(0.0)
    assert np.degrees(seen.incidence_rad) == pytest.approx(
        np.degrees(np.arcsin(np.sin(np.pi / 4) / 1.5))
    )


@pytest.mark.parametrize("aspecular", [15.0, 45.0, 80.0])
def test_lamp_and_detector_may_change_places(aspecular: float) -> None:
    forward = rays(aspecular, 45.0)
    # The view at 45 − aspecular becomes the lamp, 45 the view on the mirror side.
    backward = rays(aspecular, aspecular - 45.0)

    assert np.abs(backward.tilt_rad) == pytest.approx(np.abs(forward.tilt_rad))
    assert backward.incidence_rad == pytest.approx(forward.incidence_rad)
    assert backward.transmission == pytest.approx(forward.transmission)


@pytest.mark.parametrize(
    ("aspecular", "illumination", "named"),
    [
        (-45.0, 45.0, "view at 90 degrees"),
        (140.0, 45.0, "view at -95 degrees"),
        (15.0, 95.0, "illumination at 95 degrees"),
        (np.nan, 45.0, "view at nan degrees"),
    ],
)
def test_geometry_below_the_panel_is_refused(
    aspecular: float, illumination: float, named: str
) -> None:
    with pytest.raises(InputError, match=f"{named} .* does not reach a panel"):
        rays(aspecular, illumination)
