"""Options of a driver: a frozen dataclass that describes and checks itself."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol, TypeVar

from paintlink.errors import ConfigError
from paintlink.instrument._text import did_you_mean

T = TypeVar("T")
_KINDS = {bool: "true or false", int: "a whole number", float: "a number", str: "text"}


class OptionSet(Protocol):
    """A frozen dataclass whose fields were made by `option`."""

    __dataclass_fields__: ClassVar[dict[str, dataclasses.Field[Any]]]


OptionsT = TypeVar("OptionsT", bound=OptionSet)


@dataclass(frozen=True, slots=True)
class Option:
    """One option: its default gives the type, the rest bounds it."""

    name: str
    default: object
    help: str
    choices: tuple[object, ...] = ()
    minimum: float | None = None
    maximum: float | None = None

    @property
    def allowed(self) -> str:
        """What a value must be, in words."""
        if self.choices:
            return "one of " + ", ".join(repr(choice) for choice in self.choices)
        if isinstance(self.default, tuple):
            return f"{len(self.default)} different whole numbers{self._range}"
        return _KINDS[type(self.default)] + self._range

    @property
    def _range(self) -> str:
        if self.maximum is not None:
            return f" from {self.minimum:g} to {self.maximum:g}"
        return f" from {self.minimum:g} upwards" if self.minimum is not None else ""

    def convert(self, value: object) -> object:
        """Return ``value`` in the type of the default.

        Raises
        ------
        ConfigError
            Naming the option, the value and what is allowed.
        """
        if isinstance(self.default, tuple):
            converted = self._list(value, type(self.default[0]), len(self.default))
        else:
            converted = self._one(value, type(self.default))
        if converted is None:
            hint = did_you_mean(str(value), [str(choice) for choice in self.choices])
            msg = f"option {self.name} = {value!r}{hint or ':'} must be {self.allowed}"
            raise ConfigError(msg)
        return converted

    def _list(self, value: object, kind: type, size: int) -> object | None:
        given = value if isinstance(value, list | tuple) else ()
        items = [self._one(item, kind) for item in given]
        fits = None not in items and len(items) == len(set(items)) == size
        return tuple(items) if fits else None

    def _one(self, value: object, kind: type) -> object | None:
        if kind is float and type(value) is int:
            value = float(value)
        fits = type(value) is kind and (not self.choices or value in self.choices)
        if fits and isinstance(value, int | float):
            low = -math.inf if self.minimum is None else self.minimum
            high = math.inf if self.maximum is None else self.maximum
            fits = math.isfinite(value) and low <= value <= high
        return value if fits else None


def option(
    default: T,
    help: str,
    *,
    choices: tuple[object, ...] = (),
    minimum: float | None = None,
    maximum: float | None = None,
) -> T:
    """Return a dataclass field with its bounds and the sentence that explains it."""
    bounds = {"choices": choices, "minimum": minimum, "maximum": maximum}
    return dataclasses.field(default=default, metadata={"help": help, **bounds})


def describe_options(defaults: OptionSet) -> tuple[Option, ...]:
    """Return every option of a set, in the order they were declared."""
    return tuple(
        Option(field.name, getattr(defaults, field.name), **field.metadata)
        for field in dataclasses.fields(defaults)
    )


def parse_options(defaults: OptionsT, given: Mapping[str, object]) -> OptionsT:
    """Return ``defaults`` with the given values in place of its own.

    Raises
    ------
    ConfigError
        Naming every unknown name and every wrong value at once.
    """
    known = {option.name: option for option in describe_options(defaults)}
    values: dict[str, object] = {}
    faults: list[str] = []
    for name, value in given.items():
        if name not in known:
            hint = did_you_mean(name, known) or ";"
            faults.append(f"unknown option {name!r}{hint} known: {', '.join(known)}")
            continue
        try:
            values[name] = known[name].convert(value)
        except ConfigError as fault:
            faults.append(str(fault))
    if faults:
        raise ConfigError("\n".join(faults))
    return dataclasses.replace(defaults, **values)
