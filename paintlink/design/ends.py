"""Steps that set samples, end points and the rate of travel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from paintlink.color import flop_index
from paintlink.design.limits import AB_MAX, L_MAX
from paintlink.design.parameters import Choice, Number
from paintlink.design.state import State
from paintlink.design.step import Step, only
from paintlink.design.weights import (
    FACE_DEG,
    FLOP_DEG,
    MIDDLE_DEG,
    face_weight,
    rate,
)
from paintlink.errors import DesignError
from paintlink.model import FloatArray

LIGHTNESS = Number(0.0, L_MAX)
CHROMATIC = Number(-AB_MAX, AB_MAX)
CHANNELS = Choice(("L", "a", "b", "ab", "Lab"))

USUAL_VERTEX_DEG = 80.0
"""Where a change of an end point fades out when L itself does not level off."""

FLOP_EXPONENT = 1.11
"""Exponent of the Flop Index."""


@dataclass(frozen=True)
class _Point(Step):
    """A step that sets some of L, a and b and keeps the others."""

    L: Annotated[float | None, LIGHTNESS] = None
    a: Annotated[float | None, CHROMATIC] = None
    b: Annotated[float | None, CHROMATIC] = None

    def __post_init__(self) -> None:
        Step.__post_init__(self)
        if self.L is self.a is self.b is None:
            msg = "nothing to set: give at least one of L, a, b"
            raise DesignError(msg, step=self.name)

    def wanted(self, present: FloatArray) -> FloatArray:
        """Lab with the given channels replaced."""
        given = (self.L, self.a, self.b)
        pairs = zip(given, present.tolist(), strict=True)
        return np.array([old if new is None else new for new, old in pairs])


@dataclass(frozen=True, kw_only=True)
class SetSample(_Point):
    """Lab of one sample."""

    name: ClassVar[str] = "set-sample"
    angle_deg: Annotated[float, Number(FACE_DEG, FLOP_DEG, "degrees")]

    def target(self, state: State) -> FloatArray:
        """The samples with this one replaced."""
        if self.angle_deg not in state.angles_deg:
            known = ", ".join(f"{angle:g}" for angle in state.angles_deg)
            msg = (
                f"no sample at {self.angle_deg:g} degrees: angle_deg is one of {known}"
            )
            raise DesignError(msg, step=self.name, parameter="angle_deg")
        lab = state.lab.copy()
        lab[state.angles_deg.index(self.angle_deg)] = self.wanted(
            state.at(self.angle_deg)
        )
        return lab


@dataclass(frozen=True)
class SetFace(_Point):
    """Colour of the face; the flop stays, what lies between follows the travel."""

    name: ClassVar[str] = "set-face"

    def target(self, state: State) -> FloatArray:
        """The change at 15 degrees, fading towards the flop."""
        change = self.wanted(state.face) - state.face
        return state.lab + change * _fading(state)


@dataclass(frozen=True)
class SetFlop(_Point):
    """Colour of the flop; the face stays, what lies between follows the travel."""

    name: ClassVar[str] = "set-flop"

    def target(self, state: State) -> FloatArray:
        """The change at 110 degrees, fading towards the face."""
        change = self.wanted(state.flop) - state.flop
        return state.lab + change * (1.0 - _fading(state))


@dataclass(frozen=True)
class SetTravel(Step):
    """Angle at which the travel levels off, with face and flop as they are."""

    name: ClassVar[str] = "set-travel"
    vertex_deg: Annotated[float, Number(MIDDLE_DEG, FLOP_DEG, "degrees", open=True)]
    channels: Annotated[str, CHANNELS] = "L"

    def target(self, state: State) -> FloatArray:
        """The paper's clamped quadratic between the end points."""
        weight = face_weight(state.column, self.vertex_deg)
        curve = state.flop + (state.face - state.flop) * weight
        # The ends are kept as they are, not computed anew.
        curve[0], curve[-1] = state.face, state.flop
        return only(self.channels, curve, state.lab)


@dataclass(frozen=True)
class SetFlopIndex(Step):
    """Flop Index, by more or less travel of L about 45 degrees."""

    name: ClassVar[str] = "set-flop-index"
    flop_index: Annotated[float, Number(0.0, 50.0)]

    def target(self, state: State) -> FloatArray:
        """L scaled by the power of the ratio of the indices."""
        present = flop_index([state.face, state.middle, state.flop])
        if not present:
            msg = "there is no travel in L to scale: use set-face or set-flop first"
            raise DesignError(msg, step=self.name, parameter="flop_index")
        factor = (self.flop_index / present) ** (1.0 / FLOP_EXPONENT)
        return scaled_travel(state, factor, "L")


def scaled_travel(state: State, factor: float, channels: str) -> FloatArray:
    """Lab with the differences to 45 degrees multiplied, on the channels."""
    stretched = state.middle + factor * (state.lab - state.middle)
    return only(channels, stretched, state.lab)


def _fading(state: State) -> FloatArray:
    vertex_deg = rate(state.face[0], state.middle[0], state.flop[0]).vertex_deg
    chosen = USUAL_VERTEX_DEG if vertex_deg is None else vertex_deg
    return face_weight(state.column, chosen)
