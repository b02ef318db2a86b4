"""Colours that can be: a convex set, so that every limit has a closed form.

XYZ ≥ 0 is the same as L ≥ 0, a ≥ −500/116 L and b ≤ 200/116 L.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import L_RANGE, FloatArray

L_MAX = L_RANGE[1]
AB_MAX = 200.0

TOLERANCE = 1e-9
"""Lab units a colour may lie outside, so that rounding never blocks a step."""

_INWARDS = np.array([
    [1.0, 0.0, 0.0],
    [1.0, 116.0 / 500.0, 0.0],
    [1.0, 0.0, -116.0 / 200.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
])
_OFFSETS = np.array([0.0, 0.0, 0.0, L_MAX, AB_MAX, AB_MAX, AB_MAX, AB_MAX])
_LOWEST = np.array([0.0, -AB_MAX, -AB_MAX])
_HIGHEST = np.array([L_MAX, AB_MAX, AB_MAX])


def room(lab: ArrayLike) -> FloatArray:
    """Lab units left before each limit, shape (..., 8); negative outside."""
    # No matrix product: its last bits may depend on the machine's BLAS.
    values = np.asarray(lab, dtype=np.float64)[..., np.newaxis, :]
    left: FloatArray = (values * _INWARDS).sum(axis=-1) + _OFFSETS
    return left


def possible(lab: ArrayLike) -> bool:
    """Whether a surface can have all of these colours."""
    finite = bool(np.isfinite(lab).all())
    return finite and bool((room(lab) >= -TOLERANCE).all())


def share(lab: FloatArray, target: FloatArray) -> float:
    """Largest part, 0 to 1, of the straight way to ``target`` that stays possible."""
    now, then = np.maximum(room(lab), 0.0), room(target)
    broken = then < -TOLERANCE
    shares = now[broken] / (now - then)[broken]
    return float(shares.min(initial=1.0))


def along(lab: FloatArray, target: FloatArray, part: float) -> FloatArray:
    """Lab after this part of the straight way, kept clear of rounding at its end."""
    if part == 1.0:
        return target
    mixed: FloatArray = np.clip(lab + part * (target - lab), _LOWEST, _HIGHEST)
    return mixed


def with_possible_chroma(target: FloatArray) -> tuple[FloatArray, float]:
    """Lab with the hue kept and every chroma times the largest factor that is possible.

    The factor, at most 1, is returned beside it. An L below 0 becomes black.
    """
    neutral = target * np.array([1.0, 0.0, 0.0])
    factor = share(neutral, target)
    return along(neutral, target, factor), factor
