"""Shape-preserving piecewise cubic through every measured angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.curve import CurveModel
from paintlink.model import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class PchipCurve:
    """Cubic Hermite pieces between the measured angles, constant beyond them.

    Parameters
    ----------
    lab, slopes
        Lab and its slope per degree at the measured angles, shape (..., angles, 3).
    """

    angles_deg: tuple[float, ...]
    lab: FloatArray
    slopes: FloatArray
    model: CurveModel = "pchip"

    def __call__(self, aspecular_deg: ArrayLike) -> FloatArray:
        """Lab at the given angles, shape (..., *shape of the angles, 3)."""
        knots = np.array(self.angles_deg)
        theta = np.clip(np.asarray(aspecular_deg, np.float64), knots[0], knots[-1])
        left = np.clip(np.searchsorted(knots, theta, "right") - 1, 0, knots.size - 2)
        width = (knots[left + 1] - knots[left])[..., np.newaxis]
        u = (theta - knots[left])[..., np.newaxis] / width
        v = 1.0 - u
        y0, y1 = self.lab[..., left, :], self.lab[..., left + 1, :]
        m0, m1 = self.slopes[..., left, :], self.slopes[..., left + 1, :]
        rise = (y1 - y0) * (u * u * (1.0 + 2.0 * v))
        lab: FloatArray = y0 + rise + width * u * v * (v * m0 - u * m1)
        return lab


def pchip(angles_deg: tuple[float, ...], lab: FloatArray) -> PchipCurve:
    """The monotone cubic through all points, −15 included.

    Between two measurements it never leaves the range of the two. One-sided at the
    ends, harmonic means of the neighbouring slopes inside.

    References
    ----------
    Fritsch, Carlson, SIAM J. Numer. Anal. 17 (1980); Fritsch, Butland, SIAM J. Sci.
    Stat. Comput. 5 (1984).
    """
    h = np.diff(angles_deg)[:, np.newaxis]
    secants = np.diff(lab, axis=-2) / h
    slopes = np.empty_like(lab)
    slopes[..., 1:-1, :] = _inner_slopes(h, secants)
    slopes[..., 0, :] = _end_slope(h[:2], secants[..., :2, :])
    slopes[..., -1, :] = _end_slope(h[:-3:-1], secants[..., :-3:-1, :])
    return PchipCurve(angles_deg, lab, slopes)


def _inner_slopes(h: FloatArray, secants: FloatArray) -> FloatArray:
    """Weighted harmonic mean of both secants, 0 at an extremum."""
    before, after = secants[..., :-1, :], secants[..., 1:, :]
    w1, w2 = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    product = before * after
    mixed = w1 * after + w2 * before
    level = np.zeros_like(product)
    return np.divide((w1 + w2) * product, mixed, out=level, where=product > 0.0)


def _end_slope(h: FloatArray, secants: FloatArray) -> FloatArray:
    """Three-point slope at the outer end, limited so that the piece stays monotone."""
    near, far = secants[..., 0, :], secants[..., 1, :]
    slope = ((2.0 * h[0] + h[1]) * near - h[0] * far) / (h[0] + h[1])
    slope = np.where(np.sign(slope) == np.sign(near), slope, 0.0)
    overshoots = (np.sign(near) != np.sign(far)) & (np.abs(slope) > 3.0 * np.abs(near))
    return np.where(overshoots, 3.0 * near, slope)
