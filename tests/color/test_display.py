from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from paintlink.color import (
    into_gamut,
    lab_to_hex,
    lab_to_lch,
    lab_to_linear_srgb,
    lab_to_srgb,
    linear_to_srgb8,
    out_of_gamut,
    white,
    xyz_to_lab,
)
from paintlink.color.display import LUMINANCE, encode_srgb

lab = st.tuples(st.floats(-10, 170), st.floats(-130, 130), st.floats(-130, 130))


# The inverse of the matrix the product uses, printed to nine digits in advance.
SRGB_TO_XYZ = np.array([
    [0.41258899, 0.357428476, 0.178092523],
    [0.21277473, 0.715756281, 0.071469003],
    [0.019024037, 0.117960478, 0.93605549],
])


def lab_of(linear: np.ndarray) -> np.ndarray:
    return xyz_to_lab(100.0 * linear @ SRGB_TO_XYZ.T, white())


def test_known_lab_gives_known_srgb():  # vector 10
    encoded = encode_srgb(lab_to_linear_srgb((45, 70, 50)))

    assert encoded == pytest.approx((0.8390, 0.0310, 0.1005), abs=6e-5)


@given(st.floats(0, 100))
def test_neutrals_stay_neutral(light):
    linear = lab_to_linear_srgb((light, 0, 0))

    assert np.ptp(linear) <= 1e-12


@pytest.mark.parametrize("observer", ["2", "10"])
def test_white_is_one_for_both_observers(observer):
    assert lab_to_linear_srgb((100, 0, 0), observer) == pytest.approx([1, 1, 1])


def test_display_agrees_with_colour_science():
    colour = pytest.importorskip("colour")
    colours = np.random.default_rng(5).uniform([20, -40, -40], [90, 40, 40], (50, 3))
    xy10, xy2 = colour.XYZ_to_xy(white()), np.array([0.3127, 0.3290])

    xyz = colour.Lab_to_XYZ(colours, xy10)
    adapted = colour.adaptation.chromatic_adaptation_VonKries(
        xyz, colour.xy_to_XYZ(xy10), colour.xy_to_XYZ(xy2), transform="Bradford"
    )
    expected = colour.XYZ_to_sRGB(adapted, apply_cctf_encoding=False)

    assert lab_to_linear_srgb(colours) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize(
    ("colour", "clipped_hue_deg"),
    [((110, 35, 45), 108), ((120, -20, -30), -161), ((95, 60, 40), 45)],
)
def test_bright_colours_keep_their_hue(colour, clipped_hue_deg):
    linear = lab_to_linear_srgb(colour)

    shown, clipped = lab_of(into_gamut(linear)), lab_of(np.clip(linear, 0, 1))

    hue = lab_to_lch(np.array(colour))[2]
    assert lab_to_lch(shown)[2] == pytest.approx(hue, abs=0.001)
    assert lab_to_lch(clipped)[2] == pytest.approx(clipped_hue_deg % 360, abs=0.6)


def test_too_chromatic_colours_keep_luminance():
    linear = lab_to_linear_srgb([(40, 0, -100), (60, -120, 60), (30, 90, 0)])
    assert linear.min(axis=1).max() < 0.0

    shown = into_gamut(linear)

    assert shown @ LUMINANCE == pytest.approx(linear @ LUMINANCE, abs=1e-12)
    assert shown.min(axis=1) == pytest.approx([0, 0, 0], abs=1e-12)


@given(st.lists(st.floats(0.0, 0.8), min_size=3, max_size=3))
def test_ordinary_colours_are_left_alone(rgb):
    assert into_gamut(rgb) == pytest.approx(rgb, abs=1e-15)


@given(lab)
def test_every_colour_can_be_shown(colour):
    shown = into_gamut(lab_to_linear_srgb(colour))

    assert (shown >= 0.0).all()
    assert (shown <= 1.0).all()


def test_shoulder_rises_without_a_step():
    greys = np.linspace(0.0, 3.0, 3001)[:, np.newaxis] * np.ones(3)

    shown = into_gamut(greys)[:, 0]

    rise = np.diff(shown)
    assert (rise >= 0.0).all()
    assert rise.max() == pytest.approx(0.001)


def test_encoding_alone_does_not_clip():  # vector 44
    assert encode_srgb([-0.1, 1.5]) == pytest.approx([-1.292, 1.194], abs=5e-4)
    assert linear_to_srgb8([-0.1, -0.1, -0.1]).tolist() == [0, 0, 0]
    assert linear_to_srgb8([1.5, 1.5, 1.5]).max() < 255


@pytest.mark.parametrize(
    ("colour", "outside"),
    [
        ((100, 0, 0), False),
        ((0, 0, 0), False),
        ((45, 70, 50), False),
        ((101, 0, 0), True),
        ((40, 0, -100), True),
    ],
)
def test_gamut_is_reported_truthfully(colour, outside):
    assert out_of_gamut(colour) == outside


def test_swatches_keep_leading_axes():
    colours = np.full((4, 5, 3), 50.0)

    assert lab_to_srgb(colours).shape == (4, 5, 3)
    assert lab_to_srgb(colours).dtype == np.uint8
    assert out_of_gamut(colours).shape == (4, 5)


def test_hex_spells_the_same_bytes():
    assert lab_to_hex((0, 0, 0)) == "#000000"
    assert lab_to_hex((45, 70, 50)) == "#" + bytes(lab_to_srgb((45, 70, 50))).hex()
    assert lab_to_hex((45, 70, 50)) == "#d6081a"
