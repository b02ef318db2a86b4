"""CIEDE2000 with kL = kC = kH = 1.

References
----------
CIE 142-2001; Sharma, Wu, Dalal: The CIEDE2000 color-difference formula, Color Research
and Application 30 (2005), 21-30, whose treatment of the hue seam is followed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.lab import channels, chroma, hue_deg
from paintlink.model import FloatArray

POW_25_7 = 25.0**7


def ciede2000(standard: ArrayLike, sample: ArrayLike) -> FloatArray:
    """CIEDE2000 difference of Lab arrays (..., 3), shape (...); symmetric."""
    L1, a1, b1 = channels(standard)
    L2, a2, b2 = channels(sample)
    G = 0.5 * (1.0 - _rho(0.5 * (chroma(a1, b1) + chroma(a2, b2))))
    a1, a2 = a1 * (1.0 + G), a2 * (1.0 + G)
    C1, C2 = chroma(a1, b1), chroma(a2, b2)
    dh, mean_h = _hues(hue_deg(a1, b1), hue_deg(a2, b2))
    dH = 2.0 * np.sqrt(C1 * C2) * np.sin(np.radians(0.5 * dh))
    mean_C = 0.5 * (C1 + C2)

    x = (L2 - L1) / _lightness_weight(0.5 * (L1 + L2))
    y = (C2 - C1) / (1.0 + 0.045 * mean_C)
    z = dH / (1.0 + 0.015 * mean_C * _hue_term(mean_h))
    squared = (x * x + y * y) + z * z + _rotation(mean_C, mean_h) * y * z
    dE: FloatArray = np.sqrt(np.maximum(squared, 0.0))
    return dE


def _rho(C: FloatArray) -> FloatArray:
    # Products, not a power: the last bit of pow differs between libraries.
    c2 = C * C
    c7 = c2 * c2 * c2 * C
    rho: FloatArray = np.sqrt(c7 / (c7 + POW_25_7))
    return rho


def _hues(h1: FloatArray, h2: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Hue difference and mean hue in degrees, both the short way round the circle.

    The hue of a neutral needs no rule of its own: its chroma of 0 makes ΔH' vanish
    from every term that holds a hue.
    """
    dh = h2 - h1
    total = h1 + h2
    far = np.abs(dh) > 180.0
    dh = np.where(far, dh - np.copysign(360.0, dh), dh)
    turn = np.where(total < 360.0, 360.0, -360.0)
    return dh, 0.5 * np.where(far, total + turn, total)


def _lightness_weight(mean_L: FloatArray) -> FloatArray:
    t2 = (mean_L - 50.0) * (mean_L - 50.0)
    weight: FloatArray = 1.0 + 0.015 * t2 / np.sqrt(20.0 + t2)
    return weight


def _hue_term(mean_h: FloatArray) -> FloatArray:
    term: FloatArray = (
        1.0
        - 0.17 * np.cos(np.radians(mean_h - 30.0))
        + 0.24 * np.cos(np.radians(2.0 * mean_h))
        + 0.32 * np.cos(np.radians(3.0 * mean_h + 6.0))
        - 0.20 * np.cos(np.radians(4.0 * mean_h - 63.0))
    )
    return term


def _rotation(mean_C: FloatArray, mean_h: FloatArray) -> FloatArray:
    t = (mean_h - 275.0) / 25.0
    twist = np.radians(60.0 * np.exp(-t * t))
    rotation: FloatArray = -2.0 * _rho(mean_C) * np.sin(twist)
    return rotation
