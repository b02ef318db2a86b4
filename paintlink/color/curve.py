"""Lab as a function of the aspecular angle.

Every fit works on one paint or on many at once: Lab of shape (..., angles, 3) gives a
curve that answers (..., *shape of the asked angles, 3). One call for 6000 paints, Lab
(6000, 3, 3), costs a few milliseconds. A curve is a model: its values never go back
into a specification.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import FloatArray

CurveModel = Literal["paper_literal", "clamped", "pchip"]


class Curve(Protocol):
    """Lab against aspecular degrees, constant beyond its ends."""

    @property
    def model(self) -> CurveModel:
        """Name of the model."""
        ...

    @property
    def angles_deg(self) -> tuple[float, ...]:
        """Aspecular angles of the measurements it was made from, ascending."""
        ...

    def __call__(self, aspecular_deg: ArrayLike) -> FloatArray:
        """Lab at the given angles, shape (..., *shape of the angles, 3)."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class QuadraticCurve:
    """One parabola for each channel, held constant outside [low, high].

    Parameters
    ----------
    coefficients
        A, B and C of A·θ² + B·θ + C, shape (3, ..., 3): coefficient, paints, channel.
    low_deg, high_deg
        Ends of the parabola, shape (..., 3); the model decides where they lie.
    """

    model: CurveModel
    angles_deg: tuple[float, ...]
    coefficients: FloatArray
    low_deg: FloatArray
    high_deg: FloatArray

    def __call__(self, aspecular_deg: ArrayLike) -> FloatArray:
        """Lab at the given angles, shape (..., *shape of the angles, 3)."""
        theta = np.asarray(aspecular_deg, dtype=np.float64)
        low, high = _beside(self.low_deg, theta), _beside(self.high_deg, theta)
        A, B, C = (_beside(values, theta) for values in self.coefficients)
        t = np.clip(theta[..., np.newaxis], low, high)
        lab: FloatArray = (A * t + B) * t + C
        return lab


def _beside(values: FloatArray, theta: FloatArray) -> FloatArray:
    """Shape (..., 3) with room for the axes of ``theta`` before the channels."""
    return values.reshape(*values.shape[:-1], *(1,) * theta.ndim, 3)
