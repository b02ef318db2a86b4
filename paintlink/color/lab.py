"""XYZ, CIE 1976 L*a*b* and its cylindrical form; XYZ is scaled to Y = 100."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import FloatArray

DELTA = 6.0 / 29.0
SLOPE = 1.0 / (3.0 * DELTA * DELTA)
TOE = 4.0 / 29.0
F_TO_LAB = np.array([[0.0, 500.0, 0.0], [116.0, -500.0, 200.0], [0.0, 0.0, -200.0]])
F_OFFSET = np.array([16.0, 0.0, 0.0])


def xyz_to_lab(xyz: ArrayLike, white: ArrayLike) -> FloatArray:
    """CIE L*a*b* relative to ``white``, shape (..., 3).

    L* runs above 100 for effect paints and is never clipped.

    References
    ----------
    CIE 015:2018, section 8.2.1.
    """
    t = np.asarray(xyz, dtype=np.float64) / np.asarray(white, dtype=np.float64)
    f = np.where(t > DELTA**3, np.cbrt(t), SLOPE * t + TOE)
    lab: FloatArray = f @ F_TO_LAB - F_OFFSET
    return lab


def lab_to_xyz(lab: ArrayLike, white: ArrayLike) -> FloatArray:
    """XYZ on the scale of ``white``, shape (..., 3): the inverse of `xyz_to_lab`."""
    L, a, b = channels(lab)
    fy = (L + 16.0) / 116.0
    f = np.stack([fy + a / 500.0, fy, fy - b / 200.0], axis=-1)
    t = np.where(f > DELTA, f * f * f, (f - TOE) / SLOPE)
    xyz: FloatArray = t * np.asarray(white, dtype=np.float64)
    return xyz


def lab_to_lch(lab: ArrayLike) -> FloatArray:
    """L*, chroma C* and hue angle, shape (..., 3).

    The hue angle lies in [0, 360) degrees; it is NaN where C* is 0, because a
    neutral has none.
    """
    L, a, b = channels(lab)
    C = chroma(a, b)
    h = np.where(C > 0.0, hue_deg(a, b), np.nan)
    return np.stack([L, C, h], axis=-1)


def channels(lab: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """L*, a* and b* as arrays of shape (...)."""
    lab = np.asarray(lab, dtype=np.float64)
    return lab[..., 0], lab[..., 1], lab[..., 2]


def chroma(a: FloatArray, b: FloatArray) -> FloatArray:
    """√(a·a + b·b), written so that every implementation gets the same bits."""
    C: FloatArray = np.sqrt(a * a + b * b)
    return C


def hue_deg(a: FloatArray, b: FloatArray) -> FloatArray:
    """Hue angle in [0, 360) degrees; 0 where a and b are both 0."""
    h: FloatArray = np.degrees(np.arctan2(b, a)) % 360.0
    return np.where(h >= 360.0, 0.0, h)
