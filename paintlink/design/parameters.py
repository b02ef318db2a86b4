"""What a parameter of a step may be; each kind knows its limits and their words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from types import MappingProxyType
from typing import Any, Protocol, get_type_hints

from paintlink.design.bare import bare
from paintlink.design.limits import AB_MAX, L_MAX, possible
from paintlink.model import ColorSpec, Lab

Value = float | str | Lab | ColorSpec


class Kind(Protocol):
    """A kind of parameter."""

    @property
    def words(self) -> str:
        """What is accepted."""
        ...

    def accepted(self, value: object) -> Value | None:
        """The value in its final form, or None where it cannot be used."""
        ...


@dataclass(frozen=True, slots=True)
class Number:
    """A finite number within limits; ``open`` leaves the lower one out."""

    low: float
    high: float
    unit: str = ""
    open: bool = False

    @property
    def words(self) -> str:
        """What is accepted."""
        start = "above" if self.open else "from"
        return f"a number {start} {self.low:g} to {self.high:g} {self.unit}".rstrip()

    def accepted(self, value: object) -> float | None:
        """The number; -0.0 becomes 0.0."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            return None
        above = value > self.low if self.open else value >= self.low
        return float(value) + 0.0 if above and value <= self.high else None


@dataclass(frozen=True, slots=True)
class Choice:
    """One of a few words."""

    options: tuple[str, ...]

    @property
    def words(self) -> str:
        """What is accepted."""
        return f"one of {', '.join(self.options)}"

    def accepted(self, value: object) -> str | None:
        """The word."""
        return str(value) if value in self.options else None


_CHANNEL = Number(-AB_MAX, AB_MAX)


@dataclass(frozen=True, slots=True)
class Color:
    """One colour that a surface can have."""

    @property
    def words(self) -> str:
        """What is accepted."""
        return f"L,a,b of a colour with XYZ of at least 0 and L up to {L_MAX:g}"

    def accepted(self, value: object) -> Lab | None:
        """The colour."""
        if not isinstance(value, list | tuple):
            return None
        inside = (_CHANNEL.accepted(one) for one in value)
        channels = [one for one in inside if one is not None]
        if len(channels) != 3:
            return None
        lab = Lab(*channels)
        return lab if possible(lab) else None


@dataclass(frozen=True, slots=True)
class Paint:
    """A whole paint."""

    @property
    def words(self) -> str:
        """What is accepted."""
        return "the code of a known paint or a specification file"

    def accepted(self, value: object) -> ColorSpec | None:
        """The paint as a specification of its colour only."""
        return bare(value) if isinstance(value, ColorSpec) else None


@dataclass(frozen=True, slots=True)
class Parameter:
    """One field of a step; ``default`` is None where it may be left out."""

    kind: Kind
    required: bool
    default: object = None


@cache
def parameters(step: type[Any]) -> Mapping[str, Parameter]:
    """Parameters of a kind of step by name: its annotated fields."""
    hints = get_type_hints(step, include_extras=True)
    return MappingProxyType({
        field.name: Parameter(
            kind=hints[field.name].__metadata__[0],
            required=field.default is MISSING,
            default=None if field.default is MISSING else field.default,
        )
        for field in fields(step)
    })
