from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageFilter

from paintlink.errors import InputError
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.readback import altered_geometry, read_geometry_picture
from tests.sketch.easel import OBJECTS, image_of, made, stored
from tests.sketch.icc import SRGB_CURVE, SRGB_PRIMARIES, matrix_profile


def picture(name: str = "sphere") -> Image.Image:
    return image_of(made(name).files["geometry.png"])


def decoded(image: Image.Image) -> Image.Image:
    """The numbers after a program took them for sRGB and made them linear."""
    curve = [round(255 * (code / 255) ** 2.2) for code in range(256)]
    return image.point(curve * 3)


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize(("bits", "theta", "phi"), [(8, 0.36, 0.002), (16, 2e-3, 1e-5)])
def test_angles_survive_the_picture(
    tmp_path: Path, name: str, bits: int, theta: float, phi: float
) -> None:
    setup = made(name, 512, bits)
    path = tmp_path / "geometry.png"
    path.write_bytes(setup.files["geometry.png"])

    read = read_geometry_picture(path)

    exact = pixel_geometry(setup.recipe.pose)
    np.testing.assert_array_equal(read.mask, exact.mask)
    np.testing.assert_allclose(
        read.theta_deg[read.mask], exact.theta_deg[read.mask], atol=theta
    )
    np.testing.assert_allclose(read.phi[read.mask], exact.phi[read.mask], atol=phi)
    assert altered_geometry(path, setup.recipe) == ""


@pytest.mark.parametrize("name", OBJECTS)
def test_gamma_decoded_pictures_are_refused(tmp_path: Path, name: str) -> None:
    path = stored(decoded(picture(name)), tmp_path / "geometry.png")

    with pytest.raises(InputError, match=r"check patch of 0.25 is off by 52 codes"):
        read_geometry_picture(path)
    assert "changed since the set-up" in altered_geometry(path, made(name).recipe)


def test_lossy_pictures_are_refused(tmp_path: Path) -> None:
    path = stored(picture(), tmp_path / "geometry.jpg", quality=90)

    with pytest.raises(InputError, match="has to come as RGB in PNG or TIFF"):
        read_geometry_picture(path)
    assert "the recipe is used instead" in altered_geometry(path, made().recipe)


@pytest.mark.parametrize("quality", [60, 90, 98])
def test_once_lossy_pictures_are_refused(tmp_path: Path, quality: int) -> None:
    with Image.open(stored(picture(), tmp_path / "a.jpg", quality=quality)) as lossy:
        path = stored(lossy.convert("RGB"), tmp_path / "geometry.png")

    with pytest.raises(InputError, match=r"neither 0 nor full|check patch"):
        read_geometry_picture(path)


def test_blurred_pictures_are_refused(tmp_path: Path) -> None:
    soft = picture().filter(ImageFilter.GaussianBlur(1))

    with pytest.raises(InputError, match=r"neither 0 nor full: .* resampled"):
        read_geometry_picture(stored(soft, tmp_path / "geometry.png"))


def test_pictures_with_a_profile_are_refused(tmp_path: Path) -> None:
    profile = matrix_profile(SRGB_PRIMARIES, SRGB_CURVE)
    path = stored(picture(), tmp_path / "geometry.png", icc_profile=profile)

    with pytest.raises(InputError, match="without a colour profile"):
        read_geometry_picture(path)


def test_impossible_angles_are_refused(tmp_path: Path) -> None:
    codes = np.asarray(picture()).copy()
    codes[200:260, 200:260] = (250, 250, 255)
    path = stored(Image.fromarray(codes), tmp_path / "geometry.png")

    with pytest.raises(InputError, match=r"3600 of its .* no surface can show"):
        read_geometry_picture(path)
    assert "changed since the set-up" in altered_geometry(path, made().recipe)
