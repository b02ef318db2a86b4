from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageCms

from paintlink.errors import InputError
from paintlink.sketch import pictures
from paintlink.sketch.pictures import read_picture
from tests.sketch.easel import chunk, png16, stored, tiff16
from tests.sketch.icc import ADOBE_CURVE, ADOBE_PRIMARIES, matrix_profile

RANDOM = np.random.default_rng(7)
CODES8 = RANDOM.integers(0, 256, (40, 40, 4)).astype(np.uint8)
CODES16 = RANDOM.integers(0, 65536, (40, 40, 4)).astype(np.uint16)


@pytest.mark.parametrize("suffix", ["png", "tif"])
@pytest.mark.parametrize("channels", [3, 4])
def test_eight_bits_come_back_exactly(
    tmp_path: Path, suffix: str, channels: int
) -> None:
    codes = CODES8[..., :channels]
    path = stored(Image.fromarray(codes), tmp_path / f"a.{suffix}")

    painting = read_picture(path)

    assert (painting.bits, painting.lossy, painting.notes) == (8, False, ())
    np.testing.assert_array_equal(np.rint(painting.encoded * 255), codes[..., :3])
    assert (painting.alpha is None) == (channels == 3)
    if painting.alpha is not None:
        np.testing.assert_array_equal(np.rint(painting.alpha * 255), codes[..., 3])


@pytest.mark.parametrize("channels", [3, 4])
def test_sixteen_bits_of_png_are_kept(tmp_path: Path, channels: int) -> None:
    codes = CODES16[..., :channels]

    painting = read_picture(png16(codes, tmp_path / "a.png"))

    assert painting.bits == 16
    np.testing.assert_array_equal(np.rint(painting.encoded * 65535.0), codes[..., :3])


@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("deflate", [False, True])
def test_sixteen_bits_of_tiff_are_kept(
    tmp_path: Path, channels: int, order: str, deflate: bool
) -> None:
    codes = CODES16[..., :channels]

    painting = read_picture(
        tiff16(codes, tmp_path / "a.tif", order=order, deflate=deflate)
    )

    assert painting.bits == 16
    np.testing.assert_array_equal(np.rint(painting.encoded * 65535.0), codes[..., :3])


def test_jpeg_is_marked_as_lossy(tmp_path: Path) -> None:
    path = stored(Image.new("RGB", (64, 64), (200, 30, 40)), tmp_path / "a.jpg")

    painting = read_picture(path)

    assert painting.lossy
    assert "compressed with loss" in painting.notes[0]
    assert painting.encoded[5, 5] * 255 == pytest.approx([200, 30, 40], abs=3)


def test_palette_pictures_are_read_and_noted(tmp_path: Path) -> None:
    image = Image.fromarray(CODES8[..., :3] // 128 * 255).quantize(8)

    painting = read_picture(stored(image, tmp_path / "a.png"))

    assert "at most 256 colours" in painting.notes[0]
    np.testing.assert_allclose(
        painting.encoded, np.asarray(image.convert("RGB")) / 255.0, atol=1e-6
    )


@pytest.mark.parametrize("deep", [False, True])
def test_embedded_profile_is_applied(tmp_path: Path, deep: bool) -> None:
    profile = matrix_profile(ADOBE_PRIMARIES, ADOBE_CURVE, name="Adobe")
    if deep:
        embedded = chunk(b"iCCP", b"a\0\0" + zlib.compress(profile))
        path = png16(np.full((8, 8, 3), 128 * 257), tmp_path / "a.png", embedded)
    else:
        grey = Image.new("RGB", (8, 8), (128, 128, 128))
        path = stored(grey, tmp_path / "a.png", icc_profile=profile)

    painting = read_picture(path)

    linear = (128 / 255) ** (563 / 256)
    expected = 1.055 * linear ** (1 / 2.4) - 0.055
    assert painting.encoded[0, 0] == pytest.approx([expected] * 3, abs=1e-3)
    assert painting.notes == ("converted from its profile 'Adobe' to sRGB",)


def test_colours_beyond_srgb_are_counted(tmp_path: Path) -> None:
    profile = matrix_profile(ADOBE_PRIMARIES, ADOBE_CURVE)
    green = Image.new("RGB", (8, 8), (0, 255, 0))

    painting = read_picture(stored(green, tmp_path / "a.png", icc_profile=profile))

    assert "64 pixels are beyond sRGB and were clipped" in painting.notes[0]
    assert painting.encoded.min() >= 0.0


def layered(path: Path) -> Path:
    images = [Image.new("RGB", (8, 8), tone) for tone in ("red", "blue")]
    images[0].save(path, save_all=True, append_images=images[1:])
    return path


@pytest.mark.parametrize(
    ("mode", "suffix", "words"),
    [
        ("CMYK", "tif", "in CMYK: export the flattened picture"),
        ("CMYK", "jpg", "in CMYK: export the flattened picture"),
        ("LAB", "tif", "in Lab: export"),
        ("L", "png", "one grey channel: export"),
        ("LA", "png", "one grey channel: export"),
        ("I;16", "png", "one grey channel: export"),
        ("F", "tif", "one grey channel: export"),
        ("1", "png", "one black and white channel: export"),
    ],
)
def test_other_colour_modes_are_refused(
    tmp_path: Path, mode: str, suffix: str, words: str
) -> None:
    path = stored(Image.new(mode, (16, 16)), tmp_path / f"a.{suffix}")

    with pytest.raises(InputError, match=rf"a\.{suffix}: it has|it is .*{words}"):
        read_picture(path)
    with pytest.raises(InputError, match=words):
        read_picture(path)


def test_pages_and_animations_are_refused(tmp_path: Path) -> None:
    for name in ("a.tif", "a.png"):
        with pytest.raises(InputError, match="several layers or pages: export"):
            read_picture(layered(tmp_path / name))


@pytest.mark.parametrize("suffix", ["jpg", "png", "tif"])
def test_marked_turns_are_refused_or_applied(tmp_path: Path, suffix: str) -> None:
    exif = Image.Exif()
    exif[0x0112] = 6
    path = stored(Image.new("RGB", (8, 16)), tmp_path / f"a.{suffix}", exif=exif)

    if suffix == "tif":
        assert read_picture(path).encoded.shape == (8, 16, 3)
        return
    with pytest.raises(InputError, match="marked as turned or mirrored"):
        read_picture(path)


@pytest.mark.parametrize("suffix", ["png", "jpg", "tif"])
@settings(deadline=None, max_examples=30)
@given(share=st.floats(0.0, 0.95))
def test_cut_files_are_refused(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, share: float
) -> None:
    path = tmp_path_factory.mktemp("cut") / f"a.{suffix}"
    data = stored(Image.fromarray(CODES8[..., :3]), path).read_bytes()
    path.write_bytes(data[: int(share * len(data))])

    with pytest.raises(InputError, match=r"a\.\w+: .*export the flattened picture"):
        read_picture(path)


def test_png_without_its_end_is_refused(tmp_path: Path) -> None:
    path = stored(Image.fromarray(CODES8), tmp_path / "a.png")
    path.write_bytes(path.read_bytes()[:-12])

    with pytest.raises(InputError, match="end of the file is missing"):
        read_picture(path)


@pytest.mark.parametrize("side", [6400, 12000, 60000])
def test_bombs_are_refused_unread(tmp_path: Path, side: int) -> None:
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    parts = [chunk(b"IHDR", header), chunk(b"IDAT", b""), chunk(b"IEND", b"")]
    path = tmp_path / "a.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(parts))

    with pytest.raises(InputError, match="more than 40000000"):
        read_picture(path)


def test_large_files_are_refused_unread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pictures, "MOST_BYTES", 1 << 20)
    path = tmp_path / "a.png"
    path.write_bytes(bytes((1 << 20) + 1))

    with pytest.raises(InputError, match="larger than 1 MiB"):
        read_picture(path)


def test_samples_of_another_gamma_are_refused(tmp_path: Path) -> None:
    linear = chunk(b"gAMA", struct.pack(">I", 100000))

    with pytest.raises(InputError, match="gamma 1: save it as sRGB"):
        read_picture(png16(CODES16[..., :3], tmp_path / "a.png", linear))


def test_broken_profiles_are_refused(tmp_path: Path) -> None:
    path = stored(Image.new("RGB", (8, 8)), tmp_path / "a.tif", icc_profile=b"x" * 200)

    with pytest.raises(InputError, match=r"a\.tif: its colour profile is damaged"):
        read_picture(path)


def test_srgb_of_other_programs_changes_nothing(tmp_path: Path) -> None:
    built_in = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    image = Image.fromarray(CODES8[..., :3])

    painting = read_picture(stored(image, tmp_path / "a.png", icc_profile=built_in))

    np.testing.assert_array_equal(np.rint(painting.encoded * 255), CODES8[..., :3])


def test_other_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.xcf"
    path.write_bytes(b"gimp xcf v011\0" + bytes(100))

    with pytest.raises(InputError, match=r"a\.xcf: not a picture this program reads"):
        read_picture(path)
    with pytest.raises(InputError, match=r"gone\.png: cannot be read .No such file"):
        read_picture(tmp_path / "gone.png")
