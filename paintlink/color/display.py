"""Lab D65 to sRGB for swatches and pictures.

The 10 degree white is adapted to the white of sRGB, so that neutrals stay neutral. This
is a picture, not a measurement: an observer change is not an adaptation.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from paintlink.color.lab import lab_to_xyz
from paintlink.color.spectra import white
from paintlink.model import FloatArray, Observer

BRADFORD = np.array([
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
])
XYZ_TO_SRGB = np.array([
    [3.2404542, -1.5371385, -0.4985314],
    [-0.9692660, 1.8760108, 0.0415560],
    [0.0556434, -0.2040259, 1.0572252],
])
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])

SHOULDER_FROM = 0.8
"""Linear value from which bright colours are compressed instead of clipped."""

GAMUT_TOLERANCE = 1e-6
"""Rounding of the white itself must not count as out of gamut."""


def lab_to_linear_srgb(lab: ArrayLike, observer: Observer = "10") -> FloatArray:
    """Linear sRGB, shape (..., 3), unlimited: below 0 or above 1 is out of gamut.

    1.0 in all channels is the perfect diffuser.
    """
    linear: FloatArray = lab_to_xyz(lab, white("D65", observer)) @ _from_xyz(observer)
    return linear


def linear_to_srgb8(linear: ArrayLike) -> NDArray[np.uint8]:
    """Encoded sRGB, 8 bits a channel, shape (..., 3), brought into gamut first."""
    encoded = encode_srgb(into_gamut(linear))
    return np.rint(255.0 * encoded).astype(np.uint8)


def lab_to_srgb(lab: ArrayLike) -> NDArray[np.uint8]:
    """Encoded sRGB of Lab D65/10, 8 bits a channel, shape (..., 3)."""
    return linear_to_srgb8(lab_to_linear_srgb(lab))


def lab_to_hex(lab: ArrayLike) -> str:
    """One Lab D65/10 colour the way web pages write it, such as ``#c0a080``."""
    return "#" + bytes(lab_to_srgb(lab)).hex()


def out_of_gamut(lab: ArrayLike) -> NDArray[np.bool_]:
    """Whether sRGB cannot show Lab D65/10, so that a swatch is only like it.

    The shoulder, which also darkens whites a little, does not count.
    """
    linear = lab_to_linear_srgb(lab)
    low, high = linear.min(axis=-1), linear.max(axis=-1)
    outside: NDArray[np.bool_] = (low < -GAMUT_TOLERANCE) | (high > 1 + GAMUT_TOLERANCE)
    return outside


def into_gamut(linear: ArrayLike) -> FloatArray:
    """Linear sRGB within 0 to 1, shape (..., 3), with luminance or hue kept.

    Colours too chromatic for sRGB lose chroma at their luminance; then colours above
    0.8 are scaled down along a smooth shoulder, all channels by one factor. Clipping
    each channel would turn the hue of a bright flake paint by up to 50 degrees.
    """
    rgb = _desaturated(np.asarray(linear, dtype=np.float64))
    peak = rgb.max(axis=-1, keepdims=True)
    room = 1.0 - SHOULDER_FROM
    above = np.maximum(peak - SHOULDER_FROM, 0.0)
    target = SHOULDER_FROM + room * (1.0 - np.exp(-above / room))
    scale = np.where(above > 0.0, target / np.where(above > 0.0, peak, 1.0), 1.0)
    return np.clip(rgb * scale, 0.0, 1.0)


def encode_srgb(linear: ArrayLike) -> FloatArray:
    """Transfer function of sRGB for values from 0 to 1.

    References
    ----------
    IEC 61966-2-1.
    """
    value = np.asarray(linear, dtype=np.float64)
    curve = 1.055 * np.maximum(value, 0.0) ** (1.0 / 2.4) - 0.055
    return np.where(value <= 0.0031308, 12.92 * value, curve)


def _desaturated(rgb: FloatArray) -> FloatArray:
    """Mixed with the grey of its luminance until no channel is negative."""
    Y = (rgb @ LUMINANCE)[..., np.newaxis]
    lowest = rgb.min(axis=-1, keepdims=True)
    distance = np.maximum(Y - lowest, 1e-9)
    keep = np.where(lowest < 0.0, np.clip(Y / distance, 0.0, 1.0), 1.0)
    mixed: FloatArray = Y + keep * (rgb - Y)
    return mixed


@cache
def _from_xyz(observer: Observer) -> FloatArray:
    """Matrix from XYZ (Y = 100, as a row) to linear sRGB, adaptation included."""
    target = np.linalg.solve(XYZ_TO_SRGB, np.ones(3))
    gain = (BRADFORD @ target) / (BRADFORD @ (white("D65", observer) / 100.0))
    adaptation = np.linalg.solve(BRADFORD, gain[:, np.newaxis] * BRADFORD)
    matrix: FloatArray = (XYZ_TO_SRGB @ adaptation).T / 100.0
    return matrix
