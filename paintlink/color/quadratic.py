"""The paper's quadratic, taken literally and made to meet the measurements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.color.curve import QuadraticCurve
from paintlink.model import FloatArray

VERTEX_STEP_DEG = 1.0
"""Step of the vertex search; the fit misses by ΔE 2, a finer step moves it by 0.04."""


def paper_literal(angles_deg: tuple[float, ...], lab: FloatArray) -> QuadraticCurve:
    """The parabola through the points, constant beyond its minimum.

    Least squares for more than three angles. A channel whose parabola opens downwards
    has no minimum and is held at the largest angle only. The minimum usually lies
    before 110 degrees, so the measured flop is missed, in L* by 12 in the median: use
    `clamped` for anything but a comparison with the paper.

    References
    ----------
    The paper's equation for L(θ) and the sentence on clamping below it.
    """
    angles, lab = _positive(angles_deg, lab)
    A, B, C = _parabola(angles, lab)
    minimum = np.divide(-B, 2.0 * A, out=np.full_like(A, np.inf), where=A > 0.0)
    inside = (minimum > angles[0]) & (minimum < angles[-1])
    return QuadraticCurve(
        model="paper_literal",
        angles_deg=angles_deg,
        coefficients=np.stack([A, B, C]),
        low_deg=np.full_like(A, angles[0]),
        high_deg=np.where(inside, minimum, angles[-1]),
    )


def clamped(angles_deg: tuple[float, ...], lab: FloatArray) -> QuadraticCurve:
    """A parabola that ends in its vertex and continues as a constant.

    Three angles: passes through all three measurements. A channel that does not run
    monotonically, or not steeply enough at first to level off before the last angle,
    follows the plain parabola between the measurements instead.

    More angles: least squares with a search for the vertex, which smooths; −15 and
    other negative angles lie on the far side of the mirror direction and are left out.
    """
    angles, lab = _positive(angles_deg, lab)
    fit = _through_three if angles.size == 3 else _least_squares
    coefficients, high = fit(angles, lab)
    low = np.full_like(high, angles[0])
    return QuadraticCurve("clamped", angles_deg, coefficients, low, high)


def _positive(
    angles_deg: tuple[float, ...], lab: FloatArray
) -> tuple[FloatArray, FloatArray]:
    angles = np.array(angles_deg, dtype=np.float64)
    return angles[angles > 0.0], lab[..., angles > 0.0, :]


def _parabola(
    angles: FloatArray, lab: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Least-squares A, B, C of A·θ² + B·θ + C, shape (..., 3) each.

    Fitting the rise above the last angle makes a constant channel exactly constant.
    """
    last = lab[..., -1:, :]
    solve = np.linalg.pinv(np.vander(angles / angles[-1], 3))
    A, B, C = np.moveaxis(solve @ (lab - last), -2, 0)
    return A / angles[-1] ** 2, B / angles[-1], C + last[..., 0, :]


def _through_three(
    angles: FloatArray, lab: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Coefficients and high end of the closed form, with t0 < t1 < t2 the angles.

    With s = √((y1 − y2)/(y0 − y2)) the vertex is (t1 − s·t0)/(1 − s); s = 0 is a
    channel that is level from t1 on. The vertex reaches t2 at s = (t2 − t1)/(t2 − t0),
    where the form meets the plain parabola.
    """
    t0, t1, t2 = angles
    d0 = lab[..., 0, :] - lab[..., 2, :]
    d1 = lab[..., 1, :] - lab[..., 2, :]
    left, whole = np.sign(d0) * d1, np.abs(d0)
    levels_off = (left >= 0.0) & (left < ((t2 - t1) / (t2 - t0)) ** 2 * whole)
    s = np.sqrt(np.divide(left, whole, out=np.zeros_like(left), where=levels_off))
    vertex = (t1 - s * t0) / (1.0 - s)
    A = d0 / (vertex - t0) ** 2
    form = np.stack([A, -2.0 * A * vertex, lab[..., 2, :] + A * vertex * vertex])
    plain = np.stack(_parabola(angles, lab))
    return np.where(levels_off, form, plain), np.where(levels_off, vertex, t2)


def _least_squares(
    angles: FloatArray, lab: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Coefficients and high end of the best vertex on a grid, or no vertex at all."""
    vertices = np.arange(angles[0] + 5.0, angles[-1] + VERTEX_STEP_DEG, VERTEX_STEP_DEG)
    rise = np.maximum(vertices[:, np.newaxis] - angles, 0.0) ** 2
    last = lab[..., -1, :]
    y = lab - lab[..., -1:, :]
    slopes, residuals = _regress(rise, y)
    best = np.argmin(residuals, axis=-2, keepdims=True)
    A = np.take_along_axis(slopes, best, axis=-2)[..., 0, :]
    vertex = vertices[best[..., 0, :]]
    C = y.mean(axis=-2) - A * rise.mean(axis=1)[best[..., 0, :]] + last
    form = np.stack([A, -2.0 * A * vertex, C + A * vertex * vertex])
    plain = np.stack(_parabola(angles, lab))
    better = _open_ended(plain, angles) & (
        _misfit(plain, angles, lab) < residuals.min(axis=-2)
    )
    return np.where(better, plain, form), np.where(better, angles[-1], vertex)


def _regress(rise: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Slope and residual of y = c + a·rise for each vertex, (..., vertices, 3)."""
    rise = rise - rise.mean(axis=1, keepdims=True)
    y = y - y.mean(axis=-2, keepdims=True)
    spread = (rise * rise).sum(axis=1)[:, np.newaxis]
    slope = (rise @ y) / spread
    return slope, (y * y).sum(axis=-2)[..., np.newaxis, :] - slope * slope * spread


def _open_ended(parabola: FloatArray, angles: FloatArray) -> NDArray[np.bool_]:
    """Whether the vertex lies outside the measured angles, or there is none."""
    A, B, _ = parabola
    first, last = 2.0 * A * angles[0] + B, 2.0 * A * angles[-1] + B
    return np.asarray(first * last >= 0.0)


def _misfit(parabola: FloatArray, angles: FloatArray, lab: FloatArray) -> FloatArray:
    A, B, C = parabola[..., np.newaxis, :]
    t = angles[:, np.newaxis]
    error = (A * t + B) * t + C - lab
    misfit: FloatArray = (error * error).sum(axis=-2)
    return misfit
