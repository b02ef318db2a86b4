"""Paint as a short sum: splines of the aspecular angle, and one term for −15."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from paintlink.color import (
    drawing_curve,
    lab_to_linear_srgb,
    lab_to_xyz,
    white,
    xyz_to_lab,
)
from paintlink.color.display import LUMINANCE
from paintlink.model import ColorSpec, FloatArray, Observer
from paintlink.preview.spline import CORNER_DEG, DEGREE, END_DEG, SPLINES, splines

TERMS = SPLINES + 1
FAR_SIDE_ENDS_DEG = 45.0
PAINTS_AT_ONCE = 64
"""Many more, and OpenBLAS starts threads that cost more than they bring."""

THETA_DEG = np.concatenate([
    np.arange(0.0, 30.0, 0.75),
    np.arange(30.0, 60.0, 1.5),
    np.arange(60.0, END_DEG + 1e-9, 2.5),
])
"""Where a curve is looked at for its fit: densest where lamps are reflected."""


def far_side(angles_deg: ArrayLike) -> FloatArray:
    """How much of the −15 reading shows at an angle beyond the mirror direction.

    1 at 15 degrees, 0 at the mirror direction and from 45 on, smooth between. The
    course between is an assumption; the values at 15 on either side are measured.
    """
    angles = np.asarray(angles_deg, dtype=np.float64)
    rising = np.clip(angles / CORNER_DEG, 0.0, 1.0)
    past = (angles - CORNER_DEG) / (FAR_SIDE_ENDS_DEG - CORNER_DEG)
    falling = 1.0 - np.clip(past, 0.0, 1.0)
    up, down = (t * t * (3.0 - 2.0 * t) for t in (rising, falling))
    share: FloatArray = up * down
    return share


def coefficients(specs: Sequence[ColorSpec]) -> FloatArray:
    """Linear sRGB coefficients of each paint, shape (paints, TERMS, 3).

    They multiply the baked light directly: the 1/pi of the diffuser is in them.
    """
    together = {(spec.angles_deg, spec.observer) for spec in specs}
    if len(together) == 1:
        (kind,) = together
        return coefficients_of(kind[0], [spec.lab() for spec in specs], kind[1])
    return np.concatenate([coefficients([spec]) for spec in specs])


def coefficients_of(
    angles_deg: Sequence[float], lab: ArrayLike, observer: Observer = "10"
) -> FloatArray:
    """Coefficients of many paints measured alike, shape (paints, TERMS, 3).

    Parameters
    ----------
    lab
        Shape (paints, angles, 3).
    """
    angles, values = tuple(angles_deg), np.asarray(lab, dtype=np.float64)
    blocks = [
        np.concatenate(
            [
                fit(reflectance(angles, part, observer)),
                far_side_step(angles, part, observer)[:, np.newaxis],
            ],
            axis=1,
        )
        for part in _blocks(values)
    ]
    return np.concatenate(blocks)


def reflectance(
    angles_deg: Sequence[float], lab: FloatArray, observer: Observer = "10"
) -> FloatArray:
    """Reflectance factor at ``THETA_DEG`` in linear sRGB, shape (paints, angles, 3)."""
    return linear(drawing_curve(angles_deg, lab)(THETA_DEG), observer)


def far_side_step(
    angles_deg: Sequence[float], lab: FloatArray, observer: Observer = "10"
) -> FloatArray:
    """How −15 differs from 15, over pi, shape (paints, 3); 0 where not measured."""
    if -CORNER_DEG not in angles_deg or CORNER_DEG not in angles_deg:
        return np.zeros((len(lab), 3))
    far, near = (
        linear(lab[:, list(angles_deg).index(angle)], observer)
        for angle in (-CORNER_DEG, CORNER_DEG)
    )
    return (far - near) / np.pi


def linear(lab: FloatArray, observer: Observer) -> FloatArray:
    """Linear sRGB of Lab; noise may ask for negative light, which is drawn as none."""
    lit = np.concatenate([np.maximum(lab[..., :1], 0.0), lab[..., 1:]], axis=-1)
    scale = white("D65", observer)
    possible = xyz_to_lab(np.maximum(lab_to_xyz(lit, scale), 0.0), scale)
    return lab_to_linear_srgb(possible, observer)


def fit(factors: FloatArray) -> FloatArray:
    """Spline coefficients of reflectance factors at ``THETA_DEG``, divided by pi.

    Parameters
    ----------
    factors
        Linear sRGB, shape (..., angles, 3); 1.0 is the perfect diffuser.

    Returns
    -------
    Shape (..., SPLINES, 3).

    Notes
    -----
    Least squares on the relative error, which is what the eye sees; the face of the
    paint weighs most because bright lamps are reflected there.
    """
    values = factors / np.pi
    weight = _weight(values @ LUMINANCE) ** 2
    basis, products, places = _products()
    normal = (weight @ products)[..., places]
    right = basis.T @ (weight[..., None] * values)
    return np.linalg.solve(normal, right).astype(np.float64)


@cache
def _products() -> tuple[FloatArray, FloatArray, NDArray[np.intp]]:
    """Splines, products of those that overlap, and which of them each pair has.

    The last product is 0, for the pairs that do not overlap.
    """
    basis = splines(THETA_DEG)
    first, second = np.indices((SPLINES, SPLINES))
    near = (second >= first) & (second - first <= DEGREE)
    places = np.full((SPLINES, SPLINES), near.sum())
    places[near] = np.arange(near.sum())
    pairs = basis[:, first[near]] * basis[:, second[near]]
    products = np.pad(pairs, ((0, 0), (0, 1)))
    return basis, products, np.minimum(places, places.T)


def _weight(luminance: FloatArray) -> FloatArray:
    solid_angle = np.sqrt(np.sin(np.radians(np.clip(THETA_DEG, 2.0, 170.0))) + 0.05)
    face = 1.0 + 2.0 * np.exp(-THETA_DEG / 15.0)
    floor = 0.02 * luminance.max(axis=-1, keepdims=True) + 1e-9
    spacing = np.sqrt(np.gradient(THETA_DEG))
    spacing[-1] *= np.sqrt((180.0 - END_DEG) / spacing[-1] ** 2)
    weight: FloatArray = spacing * solid_angle * face / (luminance + floor)
    return weight


def _blocks(values: FloatArray) -> Iterator[FloatArray]:
    for start in range(0, len(values), PAINTS_AT_ONCE):
        yield values[start : start + PAINTS_AT_ONCE]
