"""Paint as a short sum: Chebyshev polynomials of the aspecular angle."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color import (
    drawing_curve,
    lab_to_linear_srgb,
    lab_to_xyz,
    white,
    xyz_to_lab,
)
from paintlink.color.display import LUMINANCE
from paintlink.model import ColorSpec, FloatArray

TERMS = 12
THETA_MAX_DEG = 110.0
THETA_DEG = np.linspace(0.0, 180.0, 721)


def chebyshev(angles_deg: ArrayLike) -> FloatArray:
    """T_0 ... of the angle held at 110 degrees, shape (n, TERMS)."""
    angles = np.minimum(np.asarray(angles_deg, dtype=np.float64), THETA_MAX_DEG)
    x = 2.0 * angles / THETA_MAX_DEG - 1.0
    return np.polynomial.chebyshev.chebvander(x, TERMS - 1).astype(np.float64)


def coefficients(specs: Sequence[ColorSpec]) -> FloatArray:
    """Linear sRGB coefficients of each paint, shape (paints, TERMS, 3).

    They multiply the baked light directly: the 1/pi of the diffuser is in them.
    """
    return fit(np.stack([reflectance(spec) for spec in specs]))


def reflectance(spec: ColorSpec) -> FloatArray:
    """Reflectance factor at ``THETA_DEG`` in linear sRGB, shape (721, 3).

    Noise and curves that overshoot can ask for negative light: that is drawn as none.
    """
    lab = drawing_curve(spec.angles_deg, spec.lab())(THETA_DEG)
    lab[:, 0] = np.maximum(lab[:, 0], 0.0)
    scale = white("D65", spec.observer)
    possible = xyz_to_lab(np.maximum(lab_to_xyz(lab, scale), 0.0), scale)
    return lab_to_linear_srgb(possible, spec.observer)


def fit(factors: FloatArray) -> FloatArray:
    """Coefficients of reflectance factors given at ``THETA_DEG``, divided by pi.

    Parameters
    ----------
    factors
        Linear sRGB, shape (..., 721, 3); 1.0 is the perfect diffuser.

    Returns
    -------
    Shape (..., TERMS, 3).

    Notes
    -----
    Least squares on the relative error, which is what the eye sees; the face of the
    paint weighs most because bright lamps are reflected there.
    """
    values = factors / np.pi
    weight = _weight(values @ LUMINANCE) ** 2
    basis = chebyshev(THETA_DEG)
    products = (basis[:, :, None] * basis[:, None, :]).reshape(len(basis), -1)
    normal = (weight @ products).reshape(*weight.shape[:-1], TERMS, TERMS)
    right = basis.T @ (weight[..., None] * values)
    return np.linalg.solve(normal, right).astype(np.float64)


def _weight(luminance: FloatArray) -> FloatArray:
    solid_angle = np.sqrt(np.sin(np.radians(np.clip(THETA_DEG, 2.0, 170.0))) + 0.05)
    face = 1.0 + 2.0 * np.exp(-THETA_DEG / 15.0)
    floor = 0.02 * luminance.max(axis=-1, keepdims=True)
    weight: FloatArray = solid_angle * face / (luminance + floor)
    return weight
