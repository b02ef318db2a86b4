"""Colour differences by CIE76, CIE94, CMC(l:c) and DIN99.

Every function takes the standard first and the sample second, Lab of shape (..., 3)
that broadcast against each other, and gives the difference with shape (...).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.lab import channels, chroma, hue_deg
from paintlink.model import FloatArray


class Components(NamedTuple):
    """Sample minus standard, split into lightness, a, b, chroma and hue.

    ``dH`` is positive when the hue turns counter-clockwise in the a-b plane, that is
    from red towards yellow.
    """

    dL: FloatArray
    da: FloatArray
    db: FloatArray
    dC: FloatArray
    dH: FloatArray


class Cie94Constants(NamedTuple):
    """Weights of CIE94 for one field of use."""

    kL: float
    K1: float
    K2: float


GRAPHIC_ARTS = Cie94Constants(kL=1.0, K1=0.045, K2=0.015)
TEXTILES = Cie94Constants(kL=2.0, K1=0.048, K2=0.014)


def components(standard: ArrayLike, sample: ArrayLike) -> Components:
    """Signed differences of the sample from the standard."""
    L1, a1, b1 = channels(standard)
    L2, a2, b2 = channels(sample)
    da, db = a2 - a1, b2 - b1
    dC = chroma(a2, b2) - chroma(a1, b1)
    dH = np.sqrt(np.maximum((da * da + db * db) - dC * dC, 0.0))
    turn = a1 * b2 - a2 * b1
    return Components(L2 - L1, da, db, dC, np.where(turn < 0.0, -dH, dH))


def cie76(standard: ArrayLike, sample: ArrayLike) -> FloatArray:
    """Euclidean distance in Lab.

    Only correctly rounded operations in a fixed order: every implementation that
    keeps √((ΔL² + Δa²) + Δb²) gets the same 64 bits.
    """
    L1, a1, b1 = channels(standard)
    L2, a2, b2 = channels(sample)
    dL, da, db = L2 - L1, a2 - a1, b2 - b1
    dE: FloatArray = np.sqrt((dL * dL + da * da) + db * db)
    return dE


def cie94(
    standard: ArrayLike,
    sample: ArrayLike,
    constants: Cie94Constants = GRAPHIC_ARTS,
) -> FloatArray:
    """CIE94, weighted by the chroma of the standard, so not symmetric.

    References
    ----------
    CIE 116-1995.
    """
    _, a1, b1 = channels(standard)
    C1 = chroma(a1, b1)
    d = components(standard, sample)
    SC, SH = 1.0 + constants.K1 * C1, 1.0 + constants.K2 * C1
    return _norm(d.dL / constants.kL, d.dC / SC, d.dH / SH)


def cmc(
    standard: ArrayLike,
    sample: ArrayLike,
    l_factor: float = 2.0,
    c_factor: float = 1.0,
) -> FloatArray:
    """CMC(l:c), weighted by the place of the standard, so not symmetric.

    2:1 judges acceptability; car makers also use 1.5:1 and 1:1.

    References
    ----------
    Clarke, McDonald, Rigg 1984; ISO 105-J03.
    """
    L1, a1, b1 = channels(standard)
    SL, SC, SH = _cmc_weights(L1, chroma(a1, b1), hue_deg(a1, b1))
    d = components(standard, sample)
    return _norm(d.dL / (l_factor * SL), d.dC / (c_factor * SC), d.dH / SH)


def _cmc_weights(
    L1: FloatArray, C1: FloatArray, h1: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    SL = np.where(L1 < 16.0, 0.511, 0.040975 * L1 / (1.0 + 0.01765 * L1))
    SC = 0.0638 * C1 / (1.0 + 0.0131 * C1) + 0.638
    blue = (h1 >= 164.0) & (h1 <= 345.0)
    T = np.where(
        blue,
        0.56 + np.abs(0.2 * np.cos(np.radians(h1 + 168.0))),
        0.36 + np.abs(0.4 * np.cos(np.radians(h1 + 35.0))),
    )
    c2 = C1 * C1
    F = np.sqrt(c2 * c2 / (c2 * c2 + 1900.0))
    return SL, SC, SC * (F * T + 1.0 - F)


def din99(standard: ArrayLike, sample: ArrayLike) -> FloatArray:
    """Euclidean distance in the DIN99 space.

    References
    ----------
    DIN 6176; ASTM D2244-07, kE = kCH = 1.
    """
    return cie76(lab_to_din99(standard), lab_to_din99(sample))


def lab_to_din99(lab: ArrayLike) -> FloatArray:
    """L99, a99 and b99, shape (..., 3)."""
    L, a, b = channels(lab)
    cos16, sin16 = np.cos(np.radians(16.0)), np.sin(np.radians(16.0))
    e = a * cos16 + b * sin16
    f = 0.7 * (b * cos16 - a * sin16)
    G = chroma(e, f)
    scale = np.log1p(0.045 * G) / np.where(G > 0.0, 0.045 * G, 1.0)
    return np.stack([105.509 * np.log1p(0.0158 * L), e * scale, f * scale], axis=-1)


def _norm(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    length: FloatArray = np.sqrt((x * x + y * y) + z * z)
    return length
