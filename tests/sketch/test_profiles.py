from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image, ImageCms

from paintlink.color import ciede2000
from paintlink.errors import InputError
from paintlink.sketch.profiles import read_profile
from paintlink.sketch.transfer import decode_srgb, linear_srgb_to_lab
from tests.sketch.icc import (
    ADOBE_CURVE,
    ADOBE_PRIMARIES,
    P3_PRIMARIES,
    SRGB_CURVE,
    SRGB_PRIMARIES,
    gamma,
    matrix_profile,
    parametric,
    table,
)

ADOBE = matrix_profile(ADOBE_PRIMARIES, ADOBE_CURVE, name="Adobe RGB (1998)")
P3 = matrix_profile(P3_PRIMARIES, SRGB_CURVE, name="Display P3")
SRGB = matrix_profile(SRGB_PRIMARIES, SRGB_CURVE, name="sRGB")
RAMP = np.linspace(0.0, 1.0, 4096)
CURVES = {
    "power": gamma(2.2),
    "table": table(RAMP**1.8),
    "type 0": parametric(0, 2.0),
    "type 1": parametric(1, 2.2, 0.95, 0.05),
    "type 2": parametric(2, 2.2, 0.9, 0.05, 0.02),
    "type 3": SRGB_CURVE,
    "type 4": parametric(4, 2.2, 0.95, 0.03, 0.05, 0.04, 0.01, 0.002),
}


def colours() -> np.ndarray:
    """Codes sRGB can show in all the spaces, shape (n, 1, 3)."""
    return np.random.default_rng(1).integers(70, 190, (4096, 1, 3)).astype(np.uint8)


def by_littlecms(codes: np.ndarray, profile: bytes) -> np.ndarray:
    """What the library of most programs makes of the codes."""
    image = ImageCms.profileToProfile(
        Image.fromarray(codes),
        ImageCms.ImageCmsProfile(io.BytesIO(profile)),
        ImageCms.createProfile("sRGB"),
        renderingIntent=ImageCms.Intent.RELATIVE_COLORIMETRIC,
    )
    return np.asarray(image).astype(float)


def lab(encoded: np.ndarray) -> np.ndarray:
    return linear_srgb_to_lab(decode_srgb(np.clip(encoded, 0.0, 1.0)))


@pytest.mark.parametrize("profile", [ADOBE, P3, SRGB], ids=["adobe", "p3", "srgb"])
def test_conversion_agrees_with_littlecms(profile: bytes) -> None:
    codes = colours()

    encoded = read_profile(profile).convert(codes / 255.0)

    expected = by_littlecms(codes, profile)
    shown = (expected > 0).all(axis=-1) & (expected < 255).all(axis=-1)
    difference = ciede2000(lab(encoded[shown]), lab(expected[shown] / 255.0))
    assert np.median(difference) < 0.2
    assert np.abs(255.0 * encoded[shown] - expected[shown]).max() < 2.0


@pytest.mark.parametrize("curve", CURVES.values(), ids=CURVES)
def test_curves_of_every_kind_agree_with_littlecms(curve: bytes) -> None:
    codes = np.repeat(np.arange(8, 248, dtype=np.uint8), 3).reshape(-1, 1, 3)
    profile = matrix_profile(SRGB_PRIMARIES, curve)

    encoded = np.clip(read_profile(profile).convert(codes / 255.0), 0.0, 1.0)

    np.testing.assert_allclose(255.0 * encoded, by_littlecms(codes, profile), atol=1.6)


def test_srgb_stays_what_it_was() -> None:
    codes = colours() / 255.0

    np.testing.assert_allclose(read_profile(SRGB).convert(codes), codes, atol=3e-4)


def test_profile_tells_its_name() -> None:
    assert read_profile(ADOBE).name == "Adobe RGB (1998)"
    built_in = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    assert "sRGB" in read_profile(built_in).name


def test_grey_and_table_profiles_are_refused() -> None:
    grey = matrix_profile(SRGB_PRIMARIES, SRGB_CURVE, space=b"GRAY")
    with pytest.raises(InputError, match="of GRAY colours, not of RGB: convert"):
        read_profile(grey)

    with pytest.raises(InputError, match="tables instead of a matrix: convert"):
        read_profile(ADOBE.replace(b"rXYZ", b"A2B0"))


@pytest.mark.parametrize("share", [0.0, 0.1, 0.33, 0.5, 0.9, 0.99])
def test_cut_profiles_are_refused(share: float) -> None:
    with pytest.raises(InputError, match=r"colour profile .*: convert the picture"):
        read_profile(ADOBE[: int(share * len(ADOBE))])


def test_profile_with_coloured_white_is_refused() -> None:
    broken = bytearray(ADOBE)
    place = broken.index(b"XYZ ", broken.index(b"XYZ ", 140) + 4)
    broken[place + 8 : place + 12] = (5 << 16).to_bytes(4)

    with pytest.raises(InputError, match="turns white into a colour"):
        read_profile(bytes(broken))
