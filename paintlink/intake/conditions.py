"""Illuminant and observer as files spell them."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple, cast

from paintlink.errors import InputError
from paintlink.instrument import quoted
from paintlink.model import Illuminant, Observer

Scale = Literal["fraction", "percent"]
"""Of reflectance: 1 or 100 for the perfect diffuser."""

_ILLUMINANTS = {
    "D65": "D65", "D50": "D50", "A": "A", "F11": "F11", "FL11": "F11", "TL84": "F11",
}  # fmt: skip
_OBSERVERS = {
    "10": "10", "1964": "10", "2": "2", "1931": "2",
}  # fmt: skip
_SPLIT = re.compile(r"[/_,\s-]+")
_OBSERVER_WORDS = re.compile(r"deg(?:rees?)?|°|cie|observer", re.IGNORECASE)


class Conditions(NamedTuple):
    """What Lab was computed for."""

    illuminant: Illuminant
    observer: Observer

    def __str__(self) -> str:
        return f"{self.illuminant}/{self.observer}"


SPECIFICATION = Conditions("D65", "10")


def read_conditions(illuminant: str, observer: str) -> Conditions:
    """The conditions that two words name, such as ``D65`` and ``10`` or ``10_Degree``.

    Raises
    ------
    InputError
        For others than paintlink knows.
    """
    light = _ILLUMINANTS.get(illuminant.strip().upper())
    if light is None:
        known = ", ".join(dict.fromkeys(_ILLUMINANTS.values()))
        msg = (
            f"illuminant {quoted(illuminant)} is unknown (known: {known}): export "
            "Lab for D65/10, or spectra"
        )
        raise InputError(msg)
    words = _OBSERVER_WORDS.sub("", observer).strip(" _-")
    eye = _OBSERVERS.get(words)
    if eye is None:
        msg = (
            f"observer {quoted(observer)} is unknown (known: 10 and 2 degrees): export "
            "Lab for D65/10, or spectra"
        )
        raise InputError(msg)
    return Conditions(cast("Illuminant", light), cast("Observer", eye))


def split_conditions(text: str) -> Conditions:
    """The conditions in one text, such as ``D65/10`` or ``D65-10°``.

    Raises
    ------
    InputError
        When they are unknown, or the text names only one of the two.
    """
    parts = [part for part in _SPLIT.split(text.strip()) if part]
    if len(parts) != 2:
        msg = (
            f"{quoted(text)} does not name illuminant and observer: write D65/10, or "
            "export again"
        )
        raise InputError(msg)
    return read_conditions(parts[0], parts[1])
