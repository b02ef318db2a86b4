"""One complete document, and how the tests turn it into others."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

COMPLETE = Path(__file__).with_name("complete.xml").read_text()
DECLARATION, _, BODY = COMPLETE.partition("\n")

CANARY = "@CANARY@"
PORT = "@PORT@"


@dataclass(frozen=True)
class Case:
    """A document and, when it is to be refused, what the refusal must say.

    ``words`` is a regular expression. In the text, CANARY stands for the path of a file
    that nobody may open, PORT for a port that nobody may connect to.
    """

    name: str
    text: str
    words: str = ""
    line: int | None = None
    element: str | None = None
    value: str | None = None
    encoding: str = "utf-8"

    def data(self, canary: str = "/canary", port: int = 9) -> bytes:
        text = self.text.replace(CANARY, canary).replace(PORT, str(port))
        return text.encode(self.encoding, "surrogatepass")

    def __str__(self) -> str:
        return self.name


def edited(old: str, new: str, text: str = COMPLETE) -> str:
    """The document with the first ``old`` replaced."""
    assert old in text
    return text.replace(old, new, 1)


def line_of(part: str, text: str = COMPLETE) -> int:
    """Line in which the first ``part`` begins."""
    return text[: text.index(part)].count("\n") + 1


def wrong(
    name: str, old: str, new: str, words: str, *, element: str, value: str | None
) -> Case:
    """A case that is refused in the very line where ``new`` replaces ``old``."""
    return Case(name, edited(old, new), words, line_of(old), element, value)
