from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import ciede2000
from paintlink.sketch.cells import Cells, mean_cells, pixels
from paintlink.sketch.local import local_value
from paintlink.sketch.reference import without_strays
from paintlink.sketch.rounding import unrounded
from paintlink.sketch.selection import select
from paintlink.sketch.values import Painting
from tests.sketch.synthesis import (
    Paint,
    Setup,
    clamped_paint,
    exposure_for,
    noisy,
    picture,
    quantised,
    sphere,
    through_file,
)

SETUP = Setup.of(sphere(192))
FLOP = 110.0
STEEP = clamped_paint("steep", np.array([[125.0, 3, -6], [55, 2, -3], [9, 0.4, -2]]))
GREY = clamped_paint("grey", np.array([[96, -1.2, 1], [66, -0.8, 0.7], [52, 0.7, -1]]))


def encoded(paint: Paint) -> np.ndarray:
    exposure = exposure_for(SETUP.geometry, paint.reflectance)
    return picture(SETUP.geometry, paint.reflectance, exposure)


def cells(painting: Painting, paint: Paint) -> tuple[Cells, Cells]:
    """Plain and unrounded cells of a painting."""
    exposure = exposure_for(SETUP.geometry, paint.reflectance)
    chosen = select(painting, SETUP.geometry, SETUP.start)
    points = pixels(chosen.theta_deg, chosen.phi, chosen.encoded, exposure)
    inlier, _ = without_strays(points)
    fine = unrounded(
        points, inlier, painting=painting, geometry=SETUP.geometry, selection=chosen
    )
    return mean_cells(points, inlier), fine


def error(found: Cells, paint: Paint) -> float:
    return float(ciede2000(paint.curve([FLOP]), local_value(found, FLOP).lab)[0])


def test_dark_flops_come_out_of_eight_bits():
    plain, fine = cells(through_file(encoded(STEEP), "PNG"), STEEP)

    assert error(fine, STEEP) < 0.1
    assert error(fine, STEEP) < 0.5 * error(plain, STEEP)


def test_greys_come_out_of_a_jpeg():
    plain, fine = cells(through_file(encoded(GREY), "JPEG", quality=90), GREY)

    assert error(plain, GREY) > 0.4
    assert error(fine, GREY) < 0.5 * error(plain, GREY)


def test_brushwork_is_left_as_it_is():
    rough = noisy(encoded(STEEP), 0.02, np.random.default_rng(3))

    plain, fine = cells(through_file(rough, "PNG"), STEEP)

    np.testing.assert_array_equal(plain.lab, fine.lab)


@pytest.mark.parametrize("bits", [8, 16])
def test_an_unknown_file_is_taken_as_it_is(bits: int):
    painting = replace(quantised(encoded(STEEP), bits), storage=None)

    plain, fine = cells(painting, STEEP)

    np.testing.assert_array_equal(plain.lab, fine.lab)


def test_a_large_jpeg_is_saved_again_in_part():
    setup = Setup.of(sphere(640))
    exposure = exposure_for(setup.geometry, GREY.reflectance)
    large = picture(setup.geometry, GREY.reflectance, exposure)
    painting = through_file(large, "JPEG", quality=90)
    chosen = select(painting, setup.geometry, setup.start)
    points = pixels(chosen.theta_deg, chosen.phi, chosen.encoded, exposure)
    inlier, _ = without_strays(points)

    fine = unrounded(
        points, inlier, painting=painting, geometry=setup.geometry, selection=chosen
    )

    assert fine.count.sum() < 0.6 * points.phi.size
    assert error(fine, GREY) < 0.75 * error(mean_cells(points, inlier), GREY)
