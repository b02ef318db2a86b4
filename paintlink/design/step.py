"""What a step is: a function of a colour, limited to what can be."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from paintlink.design.limits import along, share
from paintlink.design.parameters import Value, parameters
from paintlink.design.state import State
from paintlink.errors import DesignError
from paintlink.model import FloatArray


@dataclass(frozen=True, eq=False)
class Applied:
    """A step, the colour it led to, and which part of it was possible."""

    step: Step
    state: State
    share: float = 1.0
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Step(ABC):
    """A step with its parameters, which are checked when it is made.

    The fields are the parameters, the first line of the docstring says what it does.

    Raises
    ------
    DesignError
        When a parameter lies outside its limits.
    """

    name: ClassVar[str]

    def __post_init__(self) -> None:
        for name, parameter in parameters(type(self)).items():
            value = getattr(self, name)
            if value is None and not parameter.required:
                continue
            accepted = parameter.kind.accepted(value)
            if accepted is None:
                msg = f"{name} must be {parameter.kind.words}, not {_shown(value)}"
                raise DesignError(msg, step=self.name, parameter=name)
            object.__setattr__(self, name, accepted)

    @property
    def values(self) -> dict[str, Value]:
        """Parameters by name, without those left out."""
        given = {name: getattr(self, name) for name in parameters(type(self))}
        return {name: value for name, value in given.items() if value is not None}

    @abstractmethod
    def target(self, state: State) -> FloatArray:
        """Lab this step aims at, possible or not, shape (angles, 3)."""

    def notes(self, state: State) -> tuple[str, ...]:
        """What had to be assumed, in words for people."""
        del state
        return ()

    def applied(self, state: State) -> Applied:
        """The step made as far as possible along the straight way to its target.

        Raises
        ------
        DesignError
            When this colour does not have what the step needs.
        """
        target = self.target(state)
        part = share(state.lab, target)
        lab = along(state.lab, target, part)
        return Applied(self, state.moved(lab), part, self.notes(state))


def only(channels: str, changed: FloatArray, lab: FloatArray) -> FloatArray:
    """``changed`` on the named channels, such as ``ab``, and ``lab`` on the others."""
    named = np.array([letter in channels for letter in "Lab"])
    return np.where(named, changed, lab)


def _shown(value: object) -> str:
    text = f"{value:g}" if isinstance(value, float) else repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
