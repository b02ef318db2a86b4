from __future__ import annotations

import numpy as np
import pytest

from paintlink.sketch.profiles import read_profile
from paintlink.sketch.storage import Compressed, Rounded
from tests.sketch.synthesis import clamped_paint, picture, sphere, through_file
from tests.sketch.trials import ADOBE_RGB, DISPLAY_P3

BLUE = clamped_paint("blue", np.array([[60.0, 0, -30], [35, 0, -25], [20, 2, -14]]))
PAINTED = picture(sphere(96), BLUE.reflectance, 1.0)


def test_rounding_again_gives_what_the_file_gave():
    read = through_file(PAINTED, "PNG")

    assert isinstance(read.storage, Rounded)
    np.testing.assert_allclose(read.storage.again(PAINTED), read.encoded, atol=1e-7)


@pytest.mark.parametrize("profile", [ADOBE_RGB, DISPLAY_P3], ids=["adobe", "p3"])
def test_rounding_happens_in_the_space_of_the_profile(profile: bytes):
    read = through_file(PAINTED, "PNG", profile)

    assert read.storage is not None
    again = read.storage.again(PAINTED)
    np.testing.assert_allclose(again, read.encoded, atol=1e-6)
    assert np.abs(again - Rounded().again(PAINTED)).max() > 1e-3


@pytest.mark.parametrize("profile", [ADOBE_RGB, DISPLAY_P3], ids=["adobe", "p3"])
def test_profiles_are_undone_and_done(profile: bytes):
    space = read_profile(profile)

    np.testing.assert_allclose(
        space.convert(space.from_srgb(PAINTED)), PAINTED, atol=2e-5
    )


@pytest.mark.parametrize("options", [
    {"quality": 90}, {"quality": 75}, {"quality": 95, "subsampling": 0},
    {"quality": 90, "subsampling": 1, "progressive": True},
])  # fmt: skip
def test_compressing_again_gives_what_the_file_gave(options: dict[str, object]):
    read = through_file(PAINTED, "JPEG", **options)

    assert isinstance(read.storage, Compressed)
    np.testing.assert_allclose(read.storage.again(PAINTED), read.encoded, atol=1e-7)


def test_only_compression_lets_neighbours_in():
    assert not Rounded().spreads
    assert Compressed({}, 0).spreads


def test_palettes_are_no_known_storage(tmp_path):
    from PIL import Image

    from paintlink.sketch.pictures import read_picture

    path = tmp_path / "few.png"
    codes = np.rint(255.0 * PAINTED).astype(np.uint8)
    Image.fromarray(codes).quantize(32).save(path)

    assert read_picture(path).storage is None
