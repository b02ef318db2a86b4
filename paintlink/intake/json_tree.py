"""JSON of unknown origin, where every value knows its path."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any, NoReturn

from paintlink.errors import InputError
from paintlink.intake.source import Source

MAX_MARKS = 2_000_000
"""Commas and opening brackets: what every further value costs."""


class Node:
    """A value of a JSON document; each getter refuses what it does not expect."""

    def __init__(self, source: Source, value: Any, path: str = "") -> None:
        self.source = source
        self.value = value
        self.path = path

    def fault(self, what: str, value: object = None) -> InputError:
        """The refusal of the document for this value."""
        return self.source.fault(self.path or "the document", what, value)

    def get(self, key: str) -> Node:
        """A member; its value is None where it is missing."""
        if not isinstance(self.value, dict):
            msg = "an object {...} is expected here: export again"
            raise self.fault(msg, self._kind())
        path = f"{self.path}.{key}" if self.path else key
        return Node(self.source, self.value.get(key), path)

    def keys(self) -> list[str]:
        """Names of the members."""
        return list(self.value) if isinstance(self.value, dict) else []

    def items(self) -> Iterator[Node]:
        """Elements of a list; none where it is missing."""
        if self.value is None:
            return
        if not isinstance(self.value, list):
            raise self.fault(
                "a list [...] is expected here: export again", self._kind()
            )
        for index, value in enumerate(self.value):
            yield Node(self.source, value, f"{self.path}[{index}]")

    def text(self) -> str:
        """A text or a number as text; empty where it is missing."""
        if self.value is None:
            return ""
        if isinstance(self.value, str):
            return self.value
        if isinstance(self.value, int | float) and not isinstance(self.value, bool):
            return f"{self.value:g}"
        raise self.fault("a text is expected here: export again", self._kind())

    def number(self) -> float:
        """A finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            msg = "a number is expected here: correct it or export again"
            raise self.fault(msg, self._kind() if self.value is None else self.value)
        value = float(self.value) if abs(self.value) < 1e300 else math.inf
        if not math.isfinite(value):
            raise self.fault("the number is too large: correct it or export again")
        return value

    def _kind(self) -> str:
        return "nothing" if self.value is None else type(self.value).__name__


def tree_of(source: Source) -> Node:
    """The document.

    Raises
    ------
    InputError
        When it is damaged, nested too deeply, or has more values than any job.
    """
    text = source.text
    if sum(text.count(mark) for mark in ",[{") > MAX_MARKS:
        raise source.fault("", "more values than a job has: split the export")
    try:
        value = json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        msg = f"damaged or cut JSON ({error.msg}): export it again"
        raise source.fault(where, msg) from error
    except RecursionError as error:
        raise source.fault("", "nested too deeply: export it again") from error
    except ValueError as error:
        raise source.fault("", f"{error}: correct it or export again") from error
    return Node(source, value)


def _refuse_constant(name: str) -> NoReturn:
    msg = f"{name} stands where a number is expected"
    raise ValueError(msg)
