"""From a colour to a spectrum: the smoothest positive one of exactly that colour."""

from __future__ import annotations

import math

import numpy as np

from paintlink.color import lab_to_xyz, weights, white
from paintlink.errors import ReadingError
from paintlink.model import FloatArray

MAX_STEPS = 100
START = math.log(10.0)
TOLERANCE_XYZ = 1e-10
SHORTEST_STEP = 1e-6


def smoothest_factors(lab: FloatArray) -> FloatArray:
    """Reflectance factors, shape (31,), whose Lab D65/10 is exactly ``lab``.

    Of all positive spectra of the colour this one has the smallest sum of squared
    slopes of the logarithm. It exceeds 1 where the colour needs it.

    Raises
    ------
    ReadingError
        When no positive spectrum has the colour: dark and very saturated at once.

    References
    ----------
    S. A. Burns, "Numerical methods for smoothest reflectance reconstruction", Color
    Research & Application 45 (2020), method LLSS.
    """
    xyz = lab_to_xyz(lab, white("D65", "10"))
    # A spectrum may be scaled without changing its log slopes: solving at the Y of
    # white makes dark colours as well conditioned as light ones.
    scale = xyz[1] / white("D65", "10")[1]
    factors = _solve(xyz / scale) if (xyz > 0.0).all() else None
    if factors is None:
        values = ", ".join(f"{value:g}" for value in lab)
        msg = f"no surface has Lab {values} (D65/10): lower the chroma or raise L"
        raise ReadingError(msg)
    factors *= scale
    return factors


def _solve(target: FloatArray) -> FloatArray | None:
    """The spectrum exp(z) with tristimulus values ``target``, if there is one.

    Newton's method on the Lagrange conditions; a step that does not bring them nearer
    is shortened.
    """
    system = _Conditions(target)
    # From above: from below, the exponential makes the first steps far too long.
    unknowns = np.concatenate([np.full(system.bands, START), np.zeros(3)])
    residual = system.residual(unknowns)
    for _ in range(MAX_STEPS):
        if _worst(residual) < TOLERANCE_XYZ:
            factors: FloatArray = np.exp(unknowns[: system.bands])
            return factors
        step = np.linalg.solve(system.jacobian(unknowns), -residual)
        length = 1.0
        while not _worst(system.residual(unknowns + length * step)) < _worst(residual):
            length /= 2.0
            if length < SHORTEST_STEP:
                return None
        unknowns += length * step
        residual = system.residual(unknowns)
    return None


def _worst(residual: FloatArray) -> float:
    return float(np.abs(residual).max())


class _Conditions:
    """First-order conditions of the smallest log slope at fixed tristimulus values.

    The unknowns are z = ln R (31) and the three multipliers.
    """

    def __init__(self, target: FloatArray) -> None:
        self._weights = weights("D65", "10", 10)
        self._target = target
        self.bands = len(self._weights)
        slopes = np.diff(np.eye(self.bands), axis=0)
        self._curvature = 2.0 * slopes.T @ slopes

    def residual(self, unknowns: FloatArray) -> FloatArray:
        z, multipliers = unknowns[: self.bands], unknowns[self.bands :]
        with np.errstate(over="ignore", invalid="ignore"):
            factors = np.exp(z)
            slope = self._curvature @ z + factors * (self._weights @ multipliers)
            return np.concatenate([slope, factors @ self._weights - self._target])

    def jacobian(self, unknowns: FloatArray) -> FloatArray:
        z, multipliers = unknowns[: self.bands], unknowns[self.bands :]
        factors = np.exp(z)
        seen = factors[:, np.newaxis] * self._weights
        inner = self._curvature + np.diag(seen @ multipliers)
        return np.block([[inner, seen], [seen.T, np.zeros((3, 3))]])
