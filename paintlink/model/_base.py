"""Vocabulary, limits and checks shared by the values."""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import ReadingError, SpecError

FloatArray = NDArray[np.float64]
Finish = Literal["solid", "metallic", "pearl", "unknown"]
Origin = Literal["real", "simulated"]
Illuminant = Literal["D65", "D50", "A", "F11"]
Observer = Literal["2", "10"]
CalibrationState = Literal["valid", "needed", "unknown"]

FINISHES: tuple[Finish, ...] = ("solid", "metallic", "pearl", "unknown")
OBSERVERS: tuple[Observer, ...] = ("10", "2")
SAMPLE_COUNTS = (3, 5, 6)
L_RANGE = (-16.0, 170.0)
AB_RANGE = (-400.0, 400.0)
ASPECULAR_RANGE_DEG = (-90.0, 180.0)
GLOSS_RANGE_GU = (0.0, 2000.0)
GLOSS_ANGLES_DEG = (20.0, 45.0, 60.0, 75.0, 85.0)


def readonly(values: Any, ndim: int) -> FloatArray:
    """Return a private float64 copy that nobody can write to, with ``ndim`` axes."""
    array = np.array(values, dtype=np.float64, ndmin=1)
    if array.ndim != ndim:
        msg = f"expected an array with {ndim} axes, got shape {array.shape}"
        raise ReadingError(msg)
    array.setflags(write=False)
    return array


def number(value: float, element: str, what: str) -> float:
    """Return ``value`` as a finite float; adding 0.0 turns -0.0 into 0.0."""
    number = float(value)
    if not math.isfinite(number):
        msg = f"{what} must be a finite number: measure again or correct the file"
        raise SpecError(msg, element=element, value=str(value))
    return number + 0.0


def within(value: float, bounds: tuple[float, float], element: str, what: str) -> None:
    if not bounds[0] <= value <= bounds[1]:
        msg = (
            f"{what} must lie between {bounds[0]:g} and {bounds[1]:g}: "
            "check the units and the column order"
        )
        raise SpecError(msg, element=element, value=f"{value:.10g}")
