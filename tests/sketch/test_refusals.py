from __future__ import annotations

import numpy as np
import pytest

from paintlink.color import lab_to_linear_srgb
from paintlink.errors import InputError
from paintlink.sketch.fit import fit_painting
from paintlink.sketch.values import Painting, PixelGeometry
from tests.sketch.synthesis import Setup, picture, sphere

SETUP = Setup.of(sphere(160))
GEOMETRY = SETUP.geometry


def painted(where: np.ndarray) -> Painting:
    solid = picture(GEOMETRY, lambda theta: np.full((*theta.shape, 3), 0.4), 0.9)
    return Painting(np.where(where[..., np.newaxis], solid, SETUP.start))


def fit(painting: Painting, geometry: PixelGeometry = GEOMETRY):
    return fit_painting(painting, geometry, SETUP.start, exposure=0.9)


def test_a_mask_of_nothing_is_refused():
    nothing = np.zeros_like(GEOMETRY.mask)
    empty = PixelGeometry(GEOMETRY.theta_deg, GEOMETRY.phi, nothing)

    with pytest.raises(InputError, match="the mask shows no object"):
        fit(painted(GEOMETRY.mask), empty)


def test_an_unchanged_picture_is_refused():
    with pytest.raises(InputError, match="nothing was painted"):
        fit(Painting(SETUP.start))


def test_a_small_touch_is_refused_with_the_way_out():
    with pytest.raises(InputError, match=r"2000 are needed.*: paint over them"):
        fit(painted(GEOMETRY.mask & (GEOMETRY.theta_deg < 20.0)))


def test_paint_in_the_gloss_only_is_refused():
    low = GEOMETRY.theta_deg < 12.0
    geometry = PixelGeometry(GEOMETRY.theta_deg, GEOMETRY.phi, GEOMETRY.mask & low)

    with pytest.raises(InputError, match="only 0 painted pixels"):
        fit(painted(low), geometry)


def test_overexposed_paint_is_refused_with_the_way_out():
    white = np.where(GEOMETRY.mask[..., np.newaxis], 1.0, SETUP.start)

    with pytest.raises(InputError, match="too bright: set up with less exposure"):
        fit(Painting(white))


def test_a_flat_fill_offers_itself_as_solid():
    flat = np.where(GEOMETRY.mask[..., np.newaxis], 0.5, SETUP.start)

    with pytest.raises(
        InputError, match=r"one flat .* Lab 53\.4, 0\.0, 0\.0 as a solid"
    ):
        fit(Painting(flat))


def test_few_strokes_do_not_hide_a_flat_fill():
    flat = np.where(GEOMETRY.mask[..., np.newaxis], 0.5, SETUP.start)
    flat[75:78, 20:140] = (0.9, 0.2, 0.1)

    with pytest.raises(InputError, match="one flat colour"):
        fit(Painting(flat))


def test_low_angles_alone_are_refused_by_the_specification():
    found = fit(painted(GEOMETRY.mask & (GEOMETRY.theta_deg < 60.0)))

    with pytest.raises(InputError, match=r"colour at 2 angles: .*75 degrees.*110"):
        found.spec()


def test_colours_outside_srgb_are_marked():
    vivid = np.array([40.0, -60.0, 10.0])
    encoded = picture(GEOMETRY, lambda theta: np.broadcast_to(
        lab_to_linear_srgb(vivid), (*theta.shape, 3)
    ), 0.9)  # fmt: skip

    found = fit(Painting(encoded))

    assert [item.outside for item in found.angles] == [1.0] * 5
    assert any("border of sRGB" in note for note in found.notes)
