"""The one way paintlink spells an XML document.

Written here rather than by libxml2, whose spelling changes between releases: the name
of a colour specification is the hash of its bytes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np

from paintlink.errors import SpecError
from paintlink.spec.violations import shortened

_DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>'
_REFUSED = re.compile(
    "[^\t\n\r\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]",
)
# Parsers turn raw line breaks into others, formatters reflow them: references stay.
_REFERENCES = str.maketrans({
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    '"': "&quot;",
    "\t": "&#9;",
    "\n": "&#10;",
    "\r": "&#13;",
})

Value = str | float | None


def decimal(value: float) -> str:
    """Shortest positional decimal that reads back as the same double."""
    number = float(value) + 0.0
    text = repr(number)
    if "e" in text:
        return np.format_float_positional(number, trim="-")
    return text.removesuffix(".0")


class Markup:
    """A document under construction, one element per line."""

    def __init__(self) -> None:
        self._lines = [_DECLARATION]
        self._indent = ""

    @contextmanager
    def element(self, tag: str, /, **attributes: Value) -> Iterator[None]:
        """Element around everything written inside the ``with`` block."""
        self._write(f"<{tag}{_attributes(tag, attributes)}>")
        self._indent += "  "
        yield
        self._indent = self._indent[:-2]
        self._write(f"</{tag}>")

    def empty(self, tag: str, /, **attributes: Value) -> None:
        """Element without content; attributes that are None are left out."""
        self._write(f"<{tag}{_attributes(tag, attributes)}/>")

    def leaf(self, tag: str, value: str | float) -> None:
        """Element around one value."""
        self._write(f"<{tag}>{_spelled(tag, value)}</{tag}>")

    def numbers(self, tag: str, values: Iterable[float]) -> None:
        """Element around each of many numbers."""
        begin, end = f"{self._indent}<{tag}>", f"</{tag}>"
        self._lines += [f"{begin}{decimal(value)}{end}" for value in values]

    def optional(self, tag: str, text: str) -> None:
        """Element around a text, left out when the text is empty."""
        if text:
            self.leaf(tag, text)

    def to_bytes(self) -> bytes:
        """The document, UTF-8, ending in a line feed."""
        return ("\n".join(self._lines) + "\n").encode()

    def _write(self, line: str) -> None:
        self._lines.append(self._indent + line)


def _attributes(element: str, attributes: dict[str, Value]) -> str:
    present = [(name, value) for name, value in attributes.items() if value is not None]
    return "".join(f' {name}="{_spelled(element, value)}"' for name, value in present)


def _spelled(element: str, value: str | float) -> str:
    if not isinstance(value, str):
        return decimal(value)
    refused = _REFUSED.search(value)
    if refused:
        code = f"U+{ord(refused[0]):04X}"
        msg = f"the character {code} cannot stand in a colour specification: remove it"
        raise SpecError(msg, element=element, value=shortened(value))
    return value.translate(_REFERENCES)
