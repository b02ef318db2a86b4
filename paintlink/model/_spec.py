"""The colour specification: one paint colour, ready to be sent anywhere."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from paintlink.errors import SpecError
from paintlink.model._base import (
    AB_RANGE,
    ASPECULAR_RANGE_DEG,
    FINISHES,
    L_RANGE,
    OBSERVERS,
    SAMPLE_COUNTS,
    CalibrationState,
    Finish,
    FloatArray,
    Observer,
    Origin,
    number,
    within,
)
from paintlink.model._reading import Gloss, Instrument, Texture


class Lab(NamedTuple):
    """One colour: L* (0 black, 100 white, more for effect paints), a*, b*."""

    L: float
    a: float
    b: float


@dataclass(frozen=True, slots=True)
class Sample:
    """Lab at one aspecular angle."""

    aspecular_deg: float
    lab: Lab

    def __post_init__(self) -> None:
        angle = number(self.aspecular_deg, "sample", "aspecular angle")
        within(angle, ASPECULAR_RANGE_DEG, "sample", "aspecular angle in degrees")
        L, a, b = (
            number(value, f"sample at {angle:g}", letter)
            for letter, value in zip("Lab", self.lab, strict=True)
        )
        within(L, L_RANGE, f"sample at {angle:g}", "L")
        within(a, AB_RANGE, f"sample at {angle:g}", "a")
        within(b, AB_RANGE, f"sample at {angle:g}", "b")
        object.__setattr__(self, "aspecular_deg", angle)
        object.__setattr__(self, "lab", Lab(L, a, b))


@dataclass(frozen=True, slots=True)
class Spectrum:
    """Reflectance factors of one aspecular angle on an even wavelength scale.

    ``factors[i]`` belongs to ``start_nm + i * step_nm``; 1.0 = 100 %.
    """

    aspecular_deg: float
    start_nm: float
    step_nm: float
    factors: tuple[float, ...]

    def __post_init__(self) -> None:
        name = f"spectrum at {self.aspecular_deg:g}"
        for field in ("aspecular_deg", "start_nm", "step_nm"):
            object.__setattr__(self, field, number(getattr(self, field), name, field))
        factors = tuple([float(value) + 0.0 for value in self.factors])
        if not all(map(math.isfinite, factors)):
            factors = tuple(number(value, name, "factor") for value in self.factors)
        if len(factors) < 2 or self.step_nm <= 0:
            msg = "a spectrum needs at least two factors and a wavelength step above 0"
            raise SpecError(msg, element=name)
        object.__setattr__(self, "factors", factors)


@dataclass(frozen=True, slots=True)
class Provenance:
    """Where a measured specification came from."""

    instrument: Instrument
    taken_at: datetime
    origin: Origin
    averaged: int = 1
    calibration: CalibrationState = "unknown"
    data_mode: str = ""

    def __post_init__(self) -> None:
        if self.taken_at.tzinfo is None:
            msg = "the time of a measurement needs its time zone"
            raise SpecError(msg, element="measurement", value=str(self.taken_at))


class AngleDifference(NamedTuple):
    """Colour difference at one aspecular angle: sample minus standard."""

    aspecular_deg: float
    dE: float
    dL: float
    da: float
    db: float
    dC: float
    dH: float


@dataclass(frozen=True, slots=True)
class StartingPaint:
    """The known paint a formulation starts from, and how far off it is.

    Differences are target minus paint: a positive dL means the target is lighter.
    """

    code: str
    library: str
    generation: str
    formula: str
    total: float
    differences: tuple[AngleDifference, ...]


@dataclass(frozen=True, slots=True)
class ColorSpec:
    """One paint colour: Lab D65 at 3, 5 or 6 aspecular angles under 45 degree light.

    Samples are kept in ascending order of their angle. Values are what was measured
    or designed; modelled values never stand in for measured ones.
    """

    name: str
    samples: tuple[Sample, ...]
    finish: Finish = "unknown"
    code: str = ""
    observer: Observer = "10"
    gloss: Gloss | None = None
    spectra: tuple[Spectrum, ...] = ()
    texture: tuple[Texture, ...] = ()
    provenance: Provenance | None = None
    starting_paint: StartingPaint | None = None

    def __post_init__(self) -> None:
        samples = tuple(sorted(self.samples, key=lambda sample: sample.aspecular_deg))
        angles = [sample.aspecular_deg for sample in samples]
        if len(samples) not in SAMPLE_COUNTS:
            msg = "a colour specification needs Lab at 3, 5 or 6 aspecular angles"
            raise SpecError(msg, element="samples", value=str(len(samples)))
        for first, second in pairwise(angles):
            if first == second:
                msg = "an aspecular angle stands twice: keep one of the two samples"
                raise SpecError(msg, element="sample", value=f"{first:g}")
        if self.finish not in FINISHES:
            msg = f"the finish must be one of {', '.join(FINISHES)}"
            raise SpecError(msg, element="finish", value=self.finish)
        if self.observer not in OBSERVERS:
            msg = "the observer must be 10 or 2 degrees"
            raise SpecError(msg, element="observer", value=self.observer)
        object.__setattr__(self, "samples", samples)

    @property
    def angles_deg(self) -> tuple[float, ...]:
        """Aspecular angles, ascending."""
        return tuple(sample.aspecular_deg for sample in self.samples)

    def lab(self, *aspecular_deg: float) -> FloatArray:
        """Lab at the given angles (all when none is given), shape (angles, 3).

        Raises
        ------
        SpecError
            When an angle was not measured.
        """
        known = {sample.aspecular_deg: sample.lab for sample in self.samples}
        wanted = aspecular_deg or self.angles_deg
        missing = [angle for angle in wanted if angle not in known]
        if missing:
            have = ", ".join(f"{angle:g}" for angle in known)
            msg = f"no Lab at this aspecular angle; the specification holds {have}"
            raise SpecError(msg, element="sample", value=f"{missing[0]:g}")
        return np.array([known[angle] for angle in wanted], dtype=np.float64)
