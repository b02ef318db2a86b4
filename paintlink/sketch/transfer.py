"""Between the encoded picture and the reflectance factor behind each pixel.

A pixel of a start picture or a sketch shows exposure · φ · f(θ) in linear sRGB.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color import lab_to_linear_srgb, white, xyz_to_lab
from paintlink.color.display import encode_srgb
from paintlink.model import FloatArray

LINEAR_END = 12.92 * 0.0031308
"""Encoded value where the straight part of the sRGB curve ends."""


def decode_srgb(encoded: ArrayLike) -> FloatArray:
    """Linear sRGB of encoded values from 0 to 1: the inverse of `encode_srgb`.

    References
    ----------
    IEC 61966-2-1.
    """
    value = np.asarray(encoded, dtype=np.float64)
    power = ((np.maximum(value, LINEAR_END) + 0.055) / 1.055) ** 2.4
    return np.where(value <= LINEAR_END, value / 12.92, power)


def linear_srgb_to_lab(linear: ArrayLike) -> FloatArray:
    """Lab D65/10, shape (..., 3): the inverse of `lab_to_linear_srgb`."""
    return xyz_to_lab(np.asarray(linear, dtype=np.float64) @ _to_xyz(), white("D65"))


def reflected_lab(encoded: FloatArray, phi: FloatArray, exposure: float) -> FloatArray:
    """Lab D65/10 of the reflectance factor that pixels show, shape (..., 3)."""
    light = (exposure * phi)[..., np.newaxis]
    return linear_srgb_to_lab(decode_srgb(encoded) / light)


def shown(lab: FloatArray, phi: FloatArray, exposure: float) -> FloatArray:
    """Encoded sRGB of pixels with this reflectance, clipped to what can be shown."""
    linear: FloatArray = lab_to_linear_srgb(lab) * (exposure * phi)[..., np.newaxis]
    return encode_srgb(np.clip(linear, 0.0, 1.0))


@cache
def _to_xyz() -> FloatArray:
    """Matrix from linear sRGB (as a row) to XYZ, the exact inverse of the display's."""
    primaries = np.diag(white("D65"))
    shares = lab_to_linear_srgb(xyz_to_lab(primaries, white("D65")))
    matrix: FloatArray = np.linalg.inv(shares) @ primaries
    return matrix
