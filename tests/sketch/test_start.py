from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from paintlink.color import ciede2000, drawing_curve, lab_to_linear_srgb
from paintlink.model import ColorSpec
from paintlink.sketch.geometry import coverage, pixel_geometry
from paintlink.sketch.pictures import read_picture
from paintlink.sketch.selection import LEAST_THETA_DEG
from paintlink.sketch.start import BRIGHTEST, beyond_srgb, exposure_for, factors
from paintlink.sketch.strip import PATCHES, read_strip
from paintlink.sketch.transfer import decode_srgb, reflected_lab
from tests.preview.truth import PEARL, RED, SILVER, paint
from tests.sketch.easel import GREY_CODE, OBJECTS, image_of, made, values

WHITE = paint((100, 0, 0), (100, 0, 0), (100, 0, 0))


@pytest.mark.parametrize("name", OBJECTS)
def test_start_picture_gives_the_paint_back(name: str) -> None:
    setup = made(name)
    geometry = pixel_geometry(setup.recipe.pose)
    used = geometry.mask & (geometry.theta_deg > LEAST_THETA_DEG) & (geometry.phi > 0.3)

    seen = values(image_of(setup.files["start.png"]))[used].astype(float)

    lab = reflected_lab(seen, geometry.phi[used].astype(float), setup.recipe.exposure)
    curve = drawing_curve(SILVER.angles_deg, SILVER.lab())
    difference = ciede2000(lab, curve(geometry.theta_deg[used]))
    assert np.median(difference) < 0.5
    assert abs(np.median(lab - curve(geometry.theta_deg[used]), axis=0)).max() < 0.1


@pytest.mark.parametrize("paint", [SILVER, RED, PEARL, WHITE])
def test_exposure_leaves_room_above_the_face(paint: ColorSpec) -> None:
    geometry = pixel_geometry(made("sphere").recipe.pose)

    exposure = exposure_for(paint, geometry)

    used = geometry.mask & (geometry.theta_deg >= LEAST_THETA_DEG)
    index = np.rint(geometry.theta_deg[used] * 64).astype(int)
    peak = exposure * (factors(paint)[index].max(axis=1) * geometry.phi[used]).max()
    assert peak <= BRIGHTEST * 1.001
    assert exposure <= BRIGHTEST


def test_bright_faces_are_not_compressed() -> None:
    curve = drawing_curve(SILVER.angles_deg, SILVER.lab())

    seen = factors(SILVER)[[15 * 64, 45 * 64]]

    assert seen[0].max() > 1.0
    np.testing.assert_allclose(seen, lab_to_linear_srgb(curve([15.0, 45.0])), atol=1e-9)


def test_background_is_neutral_grey() -> None:
    setup = made("panel")
    encoded = values(image_of(setup.files["start.png"]))
    outside = coverage(setup.recipe.pose) == 0.0
    outside[450:] = False

    assert (np.rint(255 * encoded[outside]) == GREY_CODE).all()
    assert decode_srgb(GREY_CODE / 255) == pytest.approx(0.18, abs=0.002)


@pytest.mark.parametrize("size", [256, 257, 512, 1000])
def test_strip_can_be_read_at_any_size(size: int) -> None:
    encoded = values(image_of(made("sphere", size).files["start.png"]))

    assert np.abs(read_strip(encoded) - PATCHES).max() < 1 / 255


def test_strip_lies_off_the_objects() -> None:
    for name in OBJECTS:
        cover = coverage(made(name).recipe.pose)
        assert cover[485:].max() == 0.0


def test_angles_beyond_srgb_are_named() -> None:
    cyan = paint((60, -70, -10), (60, -5, -5), (30, 0, -5))

    assert beyond_srgb(cyan, (15.0, 45.0, 110.0)) == (15.0,)
    assert beyond_srgb(SILVER, (15.0, 45.0, 110.0)) == ()


def test_sixteen_bits_refine_eight(tmp_path: Path) -> None:
    deep = tmp_path / "start.png"
    deep.write_bytes(made("sphere", 512, 16).files["start.png"])

    painting = read_picture(deep)

    coarse = values(image_of(made("sphere", 512, 8).files["start.png"]))
    assert painting.bits == 16
    assert len(np.unique(painting.encoded)) > 1000
    assert np.abs(painting.encoded - coarse).max() < 0.51 / 255
