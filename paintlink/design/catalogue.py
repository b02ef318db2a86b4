"""All steps by name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from paintlink.design.ends import SetFace, SetFlop, SetFlopIndex, SetSample, SetTravel
from paintlink.design.moves import (
    Chroma,
    Darken,
    Exposure,
    Lighten,
    Mirror,
    RotateHue,
    Travel,
)
from paintlink.design.parameters import Color, Number, parameters
from paintlink.design.step import Step
from paintlink.design.tints import TintFlop, TintHighlight, Towards
from paintlink.errors import DesignError

STEPS: Mapping[str, type[Step]] = MappingProxyType({
    kind.name: kind
    for kind in (
        SetSample,
        SetFace,
        SetFlop,
        SetTravel,
        SetFlopIndex,
        RotateHue,
        Exposure,
        Lighten,
        Darken,
        Chroma,
        Travel,
        TintHighlight,
        TintFlop,
        Towards,
        Mirror,
    )
})


def kind_of(name: str) -> type[Step]:
    """The kind of step with this name.

    Raises
    ------
    DesignError
        When there is none; names the one that comes near.
    """
    if name not in STEPS:
        msg = f"there is no step {name!r}{_near(name, STEPS)}"
        raise DesignError(msg)
    return STEPS[name]


def make_step(name: str, values: Mapping[str, object]) -> Step:
    """The step of this name with these parameters.

    Raises
    ------
    DesignError
        When the step or a parameter is unknown, is missing, or lies outside its limits.
    """
    kind = kind_of(name)
    known = parameters(kind)
    for given in values:
        if given not in known:
            msg = f"there is no parameter {given!r}{_near(given, known)}"
            raise DesignError(msg, step=name, parameter=given)
    for parameter, about in known.items():
        if about.required and parameter not in values:
            msg = f"{parameter} is missing: it is {about.kind.words}"
            raise DesignError(msg, step=name, parameter=parameter)
    return kind(**values)


def value_from_text(step: str, name: str, text: str) -> object:
    """What a person means by ``text`` as this parameter; left as it is if unclear."""
    parameter = parameters(kind_of(step)).get(name)
    try:
        if parameter and isinstance(parameter.kind, Number):
            return float(text)
        if parameter and isinstance(parameter.kind, Color):
            return [float(part) for part in text.split(",")]
    except ValueError:
        return text
    return text


def _near(name: str, known: Mapping[str, object]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name, known, n=1, cutoff=0.5)
    hint = f"did you mean {near[0]}? " if near else ""
    return f"; {hint}There are {', '.join(known)}"
