"""Steps that move the whole colour: hue, lightness, chroma, travel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from paintlink.color import lab_to_xyz, xyz_to_lab
from paintlink.design.ends import CHANNELS, scaled_travel
from paintlink.design.limits import L_MAX, with_possible_chroma
from paintlink.design.parameters import Choice, Number
from paintlink.design.state import State
from paintlink.design.step import Applied, Step, only
from paintlink.model import FloatArray

QUARTER_TURNS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
FACTOR = Number(0.0, 10.0)


@dataclass(frozen=True)
class RotateHue(Step):
    """Hue turned by one angle everywhere; lightness, chroma and all indices stay."""

    name: ClassVar[str] = "rotate-hue"
    angle_deg: Annotated[float, Number(-360.0, 360.0, "degrees, from red to yellow")]

    def target(self, state: State) -> FloatArray:
        """Every a, b turned about the neutral point."""
        cosine, sine = _turn(self.angle_deg)
        lightness, a, b = state.lab.T
        # Adding 0.0 turns -0.0 into 0.0, so that a neutral stays as it is.
        turned_a, turned_b = cosine * a - sine * b + 0.0, sine * a + cosine * b + 0.0
        return np.stack([lightness, turned_a, turned_b], axis=-1)

    def applied(self, state: State) -> Applied:
        """The turn in full, with as much of the chroma as is possible there.

        The straight way to the target would be no rotation.
        """
        lab, factor = with_possible_chroma(self.target(state))
        note = f"the hue is turned in full, chroma is kept to {factor:.1%}"
        notes = (note,) if factor < 1.0 else ()
        return Applied(self, state.moved(lab), factor, notes)


@dataclass(frozen=True)
class Exposure(Step):
    """Reflectance times a power of two: lighter or darker, chromaticity stays."""

    name: ClassVar[str] = "exposure"
    stops: Annotated[float, Number(-10.0, 10.0, "stops")]

    def target(self, state: State) -> FloatArray:
        """XYZ scaled; the white cancels out."""
        white = np.ones(3)
        return xyz_to_lab(2.0**self.stops * lab_to_xyz(state.lab, white), white)


@dataclass(frozen=True)
class Lighten(Step):
    """L raised by the same amount at every angle."""

    name: ClassVar[str] = "lighten"
    amount: Annotated[float, Number(0.0, L_MAX)]

    def target(self, state: State) -> FloatArray:
        """More L."""
        return only("L", state.lab + self.amount, state.lab)


@dataclass(frozen=True)
class Darken(Step):
    """L lowered by the same amount at every angle."""

    name: ClassVar[str] = "darken"
    amount: Annotated[float, Number(0.0, L_MAX)]

    def target(self, state: State) -> FloatArray:
        """Less L."""
        return only("L", state.lab - self.amount, state.lab)


@dataclass(frozen=True)
class Chroma(Step):
    """Chroma times a factor at every angle; 0 leaves grey without a hue."""

    name: ClassVar[str] = "chroma"
    factor: Annotated[float, FACTOR]

    def target(self, state: State) -> FloatArray:
        """More or less a and b."""
        return only("ab", self.factor * state.lab, state.lab)


@dataclass(frozen=True)
class Travel(Step):
    """Differences to 45 degrees times a factor; on L, Flop Index × factor^1.11."""

    name: ClassVar[str] = "travel"
    factor: Annotated[float, FACTOR]
    channels: Annotated[str, CHANNELS] = "L"

    def target(self, state: State) -> FloatArray:
        """More or less travel; 0 gives a solid on the channels."""
        return scaled_travel(state, self.factor, self.channels)


@dataclass(frozen=True)
class Mirror(Step):
    """Face and flop exchanged, and what lies between: 15 and 110, 25 and 75."""

    name: ClassVar[str] = "mirror"
    channels: Annotated[str, Choice(("ab", "L", "Lab"))] = "ab"

    def target(self, state: State) -> FloatArray:
        """The samples in reverse order."""
        return only(self.channels, state.lab[::-1], state.lab)


def _turn(angle_deg: float) -> tuple[float, float]:
    """Cosine and sine, exact at quarter turns: 360 degrees change no bit."""
    quarters, rest = divmod(angle_deg % 360.0, 90.0)
    if rest == 0.0:
        return QUARTER_TURNS[int(quarters) % 4]
    angle = math.radians(angle_deg % 360.0)
    return math.cos(angle), math.sin(angle)
