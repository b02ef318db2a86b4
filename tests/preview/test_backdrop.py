from __future__ import annotations

import numpy as np

from paintlink.color.display import encode_srgb
from paintlink.preview import render
from paintlink.preview.backdrop import backdrop, dither
from paintlink.preview.forms import load_shape
from tests.preview.truth import GREY

SHADOWS = ((0.0, -0.6, 0.8, 0.06),)
PLACES = np.linspace(-1, 1, 101)
X, Y = np.meshgrid(PLACES, -PLACES)


def test_backdrop_stays_clear_of_black_and_white() -> None:
    grey = backdrop(X, Y, SHADOWS)

    assert grey.min() > 0.02
    assert grey.max() < 0.75


def test_shadow_is_darkest_where_the_object_stands() -> None:
    grey = backdrop(X, Y, SHADOWS)

    row, column = np.unravel_index(np.argmin(grey), grey.shape)
    assert abs(X[row, column]) < 0.05
    assert abs(Y[row, column] + 0.6) < 0.05


def test_dither_averages_to_nothing() -> None:
    pattern = dither(slice(0, 64), 64)

    assert abs(pattern.mean()) < 1e-6
    assert -0.5 < pattern.min() < pattern.max() < 0.5
    assert len(np.unique(pattern)) == 64


def test_dither_continues_from_band_to_band() -> None:
    whole = dither(slice(0, 40), 24)

    np.testing.assert_array_equal(whole[13:], dither(slice(13, 40), 24))


def test_soft_gradients_are_finer_than_a_step() -> None:
    shape = load_shape("sphere")
    rgb = render([GREY], object="sphere", size=512, backend="cpu").rgb[:48, :, 0]
    x, y = (2 * np.arange(512) + 1) / 512 - 1, 1 - (2 * np.arange(48) + 1) / 512
    true = 255 * encode_srgb(backdrop(*np.meshgrid(x, y), shape.SHADOWS))

    error = (rgb - true).reshape(6, 8, 64, 8).mean(axis=(1, 3))
    assert np.abs(error).max() < 0.15
