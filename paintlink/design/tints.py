"""Steps that mix another colour in: at the highlight, at the flop, or everywhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from paintlink.color import default_model, fit
from paintlink.design.parameters import Choice, Color, Number, Paint
from paintlink.design.state import State
from paintlink.design.step import Step, only
from paintlink.design.weights import MIDDLE_DEG, face_weight, flop_weight
from paintlink.errors import DesignError
from paintlink.model import ColorSpec, FloatArray, Lab

AMOUNT = Number(0.0, 1.0)
CHANNELS = Choice(("Lab", "ab"))


@dataclass(frozen=True)
class TintHighlight(Step):
    """A colour mixed into the face; a vertex well beyond 45 tints the travel too."""

    name: ClassVar[str] = "tint-highlight"
    color: Annotated[Lab, Color()]
    amount: Annotated[float, AMOUNT]
    vertex_deg: Annotated[float, Number(MIDDLE_DEG + 1.0, 90.0, "degrees")] = 60.0
    channels: Annotated[str, CHANNELS] = "Lab"

    def target(self, state: State) -> FloatArray:
        """Each angle moved towards the colour by its face weight."""
        weight = self.amount * face_weight(state.column, self.vertex_deg)
        return _mixed(state, self.color, weight, self.channels)


@dataclass(frozen=True)
class TintFlop(Step):
    """A colour mixed into the flop, less and less towards the face."""

    name: ClassVar[str] = "tint-flop"
    color: Annotated[Lab, Color()]
    amount: Annotated[float, AMOUNT]
    channels: Annotated[str, CHANNELS] = "Lab"

    def target(self, state: State) -> FloatArray:
        """Each angle moved towards the colour by its flop weight."""
        weight = self.amount * flop_weight(state.column)
        return _mixed(state, self.color, weight, self.channels)


@dataclass(frozen=True)
class Towards(Step):
    """Every angle moved towards another paint; 1 is that paint."""

    name: ClassVar[str] = "towards"
    paint: Annotated[ColorSpec, Paint()]
    amount: Annotated[float, AMOUNT]

    def target(self, state: State) -> FloatArray:
        """Each angle moved towards the paint by the same part."""
        self._require_comparable(state)
        goal = self.paint.lab(*_shared(state, self.paint))
        if _missing(state, self.paint):
            goal = _on_curve(self.paint, state.angles_deg)
        return _mixed(state, goal, self.amount, "Lab")

    def notes(self, state: State) -> tuple[str, ...]:
        """Angles at which the paint was not measured."""
        missing = _missing(state, self.paint)
        listed = ", ".join(f"{angle:g}" for angle in missing)
        text = f"{self.paint.name} taken from its fitted curve at {listed} degrees"
        return (text,) if missing else ()

    def _require_comparable(self, state: State) -> None:
        if self.paint.observer != state.observer:
            msg = (
                f"{self.paint.name} is Lab of the {self.paint.observer} degree "
                f"observer, the design of {state.observer}: convert the paint first"
            )
            raise DesignError(msg, step=self.name, parameter="paint")
        lacking = {state.angles_deg[0], state.angles_deg[-1]} - {*self.paint.angles_deg}
        if lacking:
            msg = (
                f"{self.paint.name} has no Lab at {min(lacking):g} degrees, where its "
                "curve would be a guess: take a paint measured at 15 and 110"
            )
            raise DesignError(msg, step=self.name, parameter="paint")


def _mixed(
    state: State, goal: Lab | FloatArray, weight: FloatArray | float, channels: str
) -> FloatArray:
    changed = state.lab + weight * (np.asarray(goal) - state.lab)
    return only(channels, changed, state.lab)


def _shared(state: State, paint: ColorSpec) -> tuple[float, ...]:
    return tuple(angle for angle in state.angles_deg if angle in paint.angles_deg)


def _missing(state: State, paint: ColorSpec) -> tuple[float, ...]:
    return tuple(angle for angle in state.angles_deg if angle not in paint.angles_deg)


def _on_curve(paint: ColorSpec, angles_deg: tuple[float, ...]) -> FloatArray:
    """Lab of the paint at the angles, on a curve through all that was measured."""
    curve = fit(paint.angles_deg, paint.lab(), default_model(paint.angles_deg))
    return curve(angles_deg)
