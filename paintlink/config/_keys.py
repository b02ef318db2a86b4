"""How a key of the configuration file is described: its meaning and its limits."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin


@dataclass(frozen=True, slots=True)
class Key:
    """Meaning of one key in the administrator's words.

    Parameters
    ----------
    example
        Shown, switched off, where there is no default to show.
    unset
        What happens when the key is left out and there is no fixed default.
    """

    meaning: str
    example: object = None
    unset: str = ""


@dataclass(frozen=True, slots=True)
class Rule:
    """What a value must be beyond its type, in words and as a check."""

    words: str
    holds: Callable[[Any], object]

    def __get_pydantic_core_schema__(
        self, source: object, handler: Callable[[object], Any]
    ) -> Any:
        from pydantic_core import core_schema

        schema = handler(source)
        return core_schema.no_info_after_validator_function(self._check, schema)

    def _check(self, value: object) -> object:
        if not self.holds(value):
            raise ValueError(self.words)
        return value


def whole(low: int, high: int) -> Rule:
    """Whole numbers between two limits, both included."""
    words = f"a whole number from {low} to {high}"
    return Rule(words, lambda value: low <= value <= high)


def number(low: float, high: float) -> Rule:
    """Numbers between two limits, both included."""
    words = f"a number from {low:g} to {high:g}"
    return Rule(words, lambda value: low <= value <= high)


def _is_pattern(text: str) -> bool:
    from paintlink.export.names import pattern_problem

    return text.strip() != "" and pattern_problem(text) is None


Origin = Literal["real", "simulated"]
FilledText = Annotated[str, Rule("text in quotes, not empty", str.strip)]
Folder = Annotated[
    Path, Rule('a folder in quotes, without "~", such as "/srv"', Path.is_absolute)
]
FileMode = Annotated[
    str,
    Rule(
        '"06" and two digits out of 0, 4 and 6, such as "0664"',
        re.compile("06[046][046]").fullmatch,
    ),
]
NamePattern = Annotated[
    str, Rule('a pattern in quotes, such as "{date}_{name}"', _is_pattern)
]
Options = Mapping[str, object]

PLAIN_TYPES = {
    bool: "true or false",
    str: "text in quotes",
    Options: "a table, such as { key = 1 }",
}


def allowed(hint: object) -> str:
    """Words for the values that a key of this type may have."""
    for part in _parts(hint):
        if isinstance(part, Rule):
            return part.words
    words = [f'"{one}"' if isinstance(one, str) else str(one) for one in choices(hint)]
    if words:
        return f"{', '.join(words[:-1])} or {words[-1]}"
    return next(PLAIN_TYPES[part] for part in _parts(hint) if part in PLAIN_TYPES)


def choices(hint: object) -> tuple[str | int, ...]:
    """The values a key is limited to, the empty tuple when they cannot be listed."""
    for part in _parts(hint):
        if get_origin(part) is Literal:
            return get_args(part)
    return ()


def is_written_in_quotes(hint: object) -> bool:
    """Whether a key of this type holds text, a folder or a word."""
    words = any(isinstance(one, str) for one in choices(hint))
    return words or any(part in (str, Path) for part in _parts(hint))


def _parts(hint: object) -> Iterator[object]:
    yield hint
    for part in get_args(hint):
        yield from _parts(part)
