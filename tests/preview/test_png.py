from __future__ import annotations

import io
import zlib
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from paintlink import __version__
from paintlink.model import ColorSpec, Gloss
from paintlink.preview import Picture, render, to_png
from paintlink.spec import spec_id
from tests.preview.truth import RED, SILVER

NAMED = ColorSpec("Rot «Ж» 赤", RED.samples, gloss=Gloss(92.0, 20.0))


@pytest.fixture(scope="module")
def picture() -> Picture:
    return render([NAMED, SILVER], object="sphere", size=48, backend="cpu")


def test_png_opens_with_the_same_pixels(picture: Picture) -> None:
    with Image.open(io.BytesIO(to_png(picture))) as image:
        image.load()

    assert (image.format, image.mode, image.size) == ("PNG", "RGB", (48, 48))
    np.testing.assert_array_equal(np.asarray(image), picture.rgb)


def test_png_says_its_colour_space(picture: Picture) -> None:
    with Image.open(io.BytesIO(to_png(picture))) as image:
        image.load()

    assert image.info["srgb"] == 0
    assert image.info["gamma"] == pytest.approx(0.45455)


def test_png_says_what_it_shows(picture: Picture) -> None:
    data = to_png(picture)
    with Image.open(io.BytesIO(data)) as image:
        image.load()

    assert image.text["Software"] == f"paintlink {__version__}"
    assert image.text["Object"] == "sphere"
    assert image.text["Light"] == "studio"
    assert image.text["Renderer"] == "cpu: numpy, as asked for"
    assert image.text["Comment"].endswith("assumed; not for visual matching")
    for spec in (NAMED, SILVER):
        assert f"{spec_id(spec)} {spec.name}".encode() in data


def test_same_picture_gives_the_same_bytes(picture: Picture) -> None:
    again = render([NAMED, SILVER], object="sphere", size=48, backend="cpu")

    assert to_png(again) == to_png(picture)


def test_wide_pictures_are_written_too(picture: Picture) -> None:
    wide = replace(picture, rgb=np.arange(90, dtype=np.uint8).reshape(2, 15, 3))

    with Image.open(io.BytesIO(to_png(wide))) as image:
        np.testing.assert_array_equal(np.asarray(image), wide.rgb)


def test_chunks_carry_their_checksum(picture: Picture) -> None:
    data, kinds = to_png(picture)[8:], []
    while data:
        length = int.from_bytes(data[:4])
        kinds.append(data[4:8])
        assert zlib.crc32(data[4 : 8 + length]) == int.from_bytes(
            data[8 + length : 12 + length]
        )
        data = data[12 + length :]

    assert kinds[0] == b"IHDR"
    assert kinds[-2:] == [b"IDAT", b"IEND"]
