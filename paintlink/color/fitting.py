"""Choice of a curve: by name, by default, and for pictures."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.curve import Curve, CurveModel, QuadraticCurve
from paintlink.color.pchip import pchip
from paintlink.color.quadratic import clamped, paper_literal
from paintlink.errors import SpecError
from paintlink.model import FloatArray

_FITS: Mapping[CurveModel, Callable[[tuple[float, ...], FloatArray], Curve]] = (
    MappingProxyType({
        "paper_literal": paper_literal,
        "clamped": clamped,
        "pchip": pchip,
    })
)


@dataclass(frozen=True, slots=True, eq=False)
class DrawingCurve:
    """A body from the smallest measured angle on, and a face from there to 0."""

    body: Curve
    face: QuadraticCurve

    @property
    def model(self) -> CurveModel:
        """Model of the body."""
        return self.body.model

    @property
    def angles_deg(self) -> tuple[float, ...]:
        """Aspecular angles of the measurements it was made from, ascending."""
        return self.body.angles_deg

    def __call__(self, aspecular_deg: ArrayLike) -> FloatArray:
        """Lab at the given angles, shape (..., *shape of the angles, 3)."""
        theta = np.asarray(aspecular_deg, dtype=np.float64)
        below = (theta < self.angles_deg[0])[..., np.newaxis]
        return np.where(below, self.face(theta), self.body(theta))


def default_model(angles_deg: Sequence[float]) -> CurveModel:
    """``clamped`` for three angles above 0, ``pchip`` for every other set."""
    three = len(angles_deg) == 3 and min(angles_deg) > 0.0
    return "clamped" if three else "pchip"


def fit(angles_deg: Sequence[float], lab: ArrayLike, model: CurveModel) -> Curve:
    """Curve of the named model, holding its end values beyond the measured angles.

    Parameters
    ----------
    angles_deg
        Aspecular angles, ascending, at least three.
    lab
        Shape (..., angles, 3): one paint, or many in one call.

    Raises
    ------
    SpecError
        When the angles do not ascend or do not fit the Lab values, or when fewer than
        three lie on the near side of the mirror direction and the model needs them.
    """
    angles, values = _checked(angles_deg, lab)
    if model != "pchip" and len(_above_zero(angles)) < 3:
        msg = f"the {model} curve needs three angles above 0 degrees: use pchip"
        raise SpecError(msg, element="samples", value=_listed(angles))
    return _FITS[model](angles, values)


def drawing_curve(angles_deg: Sequence[float], lab: ArrayLike) -> Curve:
    """Curve for pictures, from 0 degrees on; never for a specification.

    Three angles follow `clamped`, more follow `pchip`. Below the smallest angle both
    run to 0 along the quadratic through the first, the one nearest 45, and the last
    angle, because a highlight that stops growing at 15 degrees looks flat. Pictures do
    not tell the two sides of the mirror direction apart, so −15 is left out.

    Parameters and errors are those of `fit`.
    """
    angles, values = _checked(angles_deg, lab)
    near_side = _above_zero(angles)
    if len(near_side) < 3:
        return pchip(angles, values)
    values = values[..., -len(near_side) :, :]
    face = _face(near_side, values)
    three = len(near_side) == 3
    return face if three else DrawingCurve(pchip(near_side, values), face)


def _face(angles: tuple[float, ...], lab: FloatArray) -> QuadraticCurve:
    middle = min(range(1, len(angles) - 1), key=lambda i: abs(angles[i] - 45.0))
    three = [0, middle, len(angles) - 1]
    curve = clamped(tuple(angles[i] for i in three), lab[..., three, :])
    return replace(curve, low_deg=np.zeros_like(curve.low_deg))


def _above_zero(angles: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(angle for angle in angles if angle > 0.0)


def _checked(
    angles_deg: Sequence[float], lab: ArrayLike
) -> tuple[tuple[float, ...], FloatArray]:
    angles = tuple(float(angle) for angle in angles_deg)
    values = np.asarray(lab, dtype=np.float64)
    if len(angles) < 3 or any(first >= second for first, second in pairwise(angles)):
        msg = "a curve needs at least three aspecular angles in ascending order"
        raise SpecError(msg, element="samples", value=_listed(angles))
    if values.shape[-2:] != (len(angles), 3):
        msg = f"Lab of shape {values.shape} does not fit {len(angles)} angles"
        raise SpecError(msg, element="samples", value=_listed(angles))
    return angles, values


def _listed(angles: tuple[float, ...]) -> str:
    return ", ".join(f"{angle:g}" for angle in angles)
