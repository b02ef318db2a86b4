from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec, Gloss
from paintlink.preview import caption, render, with_caption
from tests.preview.truth import RED, SILVER, as_five_angles

LONG = ColorSpec("A name that goes on and on " * 8, RED.samples, code="RM 331")


def captioned(*specs: ColorSpec, size: int = 256) -> np.ndarray:
    """The strip below the picture alone."""
    picture = render(specs, object="sphere", size=size, backend="cpu")
    return with_caption(picture).rgb[size:]


def test_picture_above_the_caption_is_untouched() -> None:
    picture = render([RED], object="sphere", size=200, backend="cpu")

    with_words = with_caption(picture)

    np.testing.assert_array_equal(with_words.rgb[:200], picture.rgb)
    assert with_words.rgb.shape[1:] == (200, 3)
    assert with_words.specs == picture.specs


def test_caption_is_dark_words_on_light_paper() -> None:
    strip = captioned(RED)

    assert np.median(strip) > 240
    assert strip.min() < 80


@pytest.mark.parametrize("size", [128, 256, 1024])
def test_words_never_touch_the_sides(size: int) -> None:
    strip = captioned(LONG, size=size)

    margins = strip[:, [0, 1, -2, -1]]
    assert (margins == caption.PAPER).all()


def test_each_name_stands_below_its_strip() -> None:
    left, right = np.split(captioned(LONG, SILVER), 2, axis=1)

    assert (left[: len(left) // 2] < 200).sum() > 2 * (
        right[: len(left) // 2] < 200
    ).sum()


def test_small_print_tells_angles_light_and_warning() -> None:
    five = as_five_angles(SILVER, seed=1)
    known = ColorSpec("known", RED.samples, gloss=Gloss(80.0, 60.0), observer="2")
    picture = render([known, five], object="sphere", size=64, backend="cpu")

    first, second = caption._small_print(picture)

    assert first == (
        "aspecular 15°, 45°, 110° | 15°, 25°, 45°, 75°, 110° · D65/2°, D65/10° "
        "· sphere, light: studio"
    )
    assert (
        second == "gloss not measured, 90 GU at 60° assumed · not for visual matching"
    )


def test_title_holds_name_and_code() -> None:
    assert caption._title(ColorSpec("Red", RED.samples, code="LY3D")) == "Red (LY3D)"
    assert caption._title(ColorSpec("Red", RED.samples)) == "Red"


def test_too_small_for_words_is_an_error() -> None:
    picture = render([RED], object="sphere", size=64, backend="cpu")

    with pytest.raises(PreviewError, match="a picture 128 pixels wide, this has 64"):
        with_caption(picture)
