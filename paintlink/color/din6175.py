"""Experimental effect-paint difference in the form of DIN 6175-2.

The formula is known to this project from one third-party program only, never from the
standard: no result may be called DIN-conform.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.difference import components
from paintlink.color.lab import channels, chroma
from paintlink.errors import SpecError
from paintlink.model import FloatArray

S_AB = 0.7


class Weights(NamedTuple):
    """Tolerances of the formula for one pair of colours at one angle."""

    SL: FloatArray
    SC: FloatArray
    SH: FloatArray
    sigma: FloatArray
    """1 where the colour is judged by a and b, 0 where by chroma and hue."""


def din6175(
    standard: ArrayLike, sample: ArrayLike, aspecular_deg: ArrayLike
) -> FloatArray:
    """ΔE_eff of Lab arrays (..., 3) at ``aspecular_deg``, shape (...); symmetric.

    Parameters
    ----------
    aspecular_deg
        Aspecular angle of each colour, broadcast against (...). Only its size counts,
        so -15 is judged as 15.

    Raises
    ------
    SpecError
        At 0 degrees, where the tolerances are infinite.

    Notes
    -----
    The user factors g of the formula are 1. An L* below 0, which only noise on a
    black gives, has the tolerance of L* = 0.
    """
    d = components(standard, sample)
    w = din6175_weights(standard, sample, aspecular_deg)
    lightness = (d.dL / w.SL) * (d.dL / w.SL)
    dE_ab = np.sqrt(lightness + (d.da * d.da + d.db * d.db) / (S_AB * S_AB))
    dC, dH = d.dC / w.SC, d.dH / w.SH
    dE_CH = np.sqrt(lightness + dC * dC + dH * dH)
    dE: FloatArray = w.sigma * dE_ab + (1.0 - w.sigma) * dE_CH
    return dE


def din6175_weights(
    standard: ArrayLike, sample: ArrayLike, aspecular_deg: ArrayLike
) -> Weights:
    """Tolerances from the geometric means of lightness and chroma."""
    gamma = _gamma(aspecular_deg)
    L1, a1, b1 = channels(standard)
    L2, a2, b2 = channels(sample)
    L = np.sqrt(np.maximum(L1, 0.0) * np.maximum(L2, 0.0))
    C = np.sqrt(chroma(a1, b1) * chroma(a2, b2))
    root_L, root_C = np.sqrt(L), np.sqrt(C)
    C0 = 10.0 + 8.0 / (1.0 + np.exp(27.0 - L))
    return Weights(
        SL=0.15 * root_L + 31.5 / gamma,
        SC=np.maximum(0.7, 0.48 * root_C - 0.35 * root_L + 42.0 / gamma),
        SH=np.maximum(0.7, 0.14 * root_C - 0.20 * root_L + 21.0 / gamma + 0.7),
        sigma=np.exp(-np.logaddexp(0.0, C - C0)),
    )


def _gamma(aspecular_deg: ArrayLike) -> FloatArray:
    gamma = np.abs(np.asarray(aspecular_deg, dtype=np.float64))
    if np.any(gamma == 0.0):
        msg = "din6175 has no tolerance at 0 degrees: leave the mirror direction out"
        raise SpecError(msg, element="sample", value="0")
    return gamma
