"""Text and numbers as foreign programs write them."""

from __future__ import annotations

import codecs
import math
import re
import unicodedata
from typing import NamedTuple

from paintlink.errors import InputError

LONGEST_NAME = 200

_BOMS = (
    (codecs.BOM_UTF32_LE, ""),
    (codecs.BOM_UTF32_BE, ""),
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_NUMBER = re.compile(
    r"(?P<body>[-+]?(?:\d{1,30}(?:\.\d{0,30})?|\.\d{1,30})(?:[eE][-+]?\d{1,3})?)"
    r"\s?(?P<percent>%?)",
    re.ASCII,
)
# A point and a comma in one number, or a comma before three digits, may be either.
_THOUSANDS = re.compile(r"[-+]?\d{1,3}([.,]\d{3})+([.,]\d+)?", re.ASCII)
_DASHES = str.maketrans({"\u2212": "-", "\u2013": "-", "\u00a0": " ", "\u202f": " "})


class Decoded(NamedTuple):
    """A text and a sentence about its encoding when that had to be guessed."""

    text: str
    note: str = ""


def decode(data: bytes, *, cut: bool = False) -> Decoded:
    """The text of a file: UTF-8, UTF-16, else Windows-1252 with a note.

    Parameters
    ----------
    cut
        The data may end within a character.

    Raises
    ------
    InputError
        When the data is binary, or damaged.
    """
    encoding, body = _marked(data)
    if encoding.startswith("utf-16"):
        body = body[: len(body) // 2 * 2] if cut else body
    try:
        text = codecs.getincrementaldecoder(encoding)().decode(body, final=not cut)
    except UnicodeDecodeError as error:
        if encoding != "utf-8" or b"\0" in body:
            line = data.count(b"\n", 0, error.start) + 1
            msg = f"line {line}: damaged text ({encoding.upper()}): export it again"
            raise InputError(msg) from error
        return Decoded(
            body.decode("cp1252", "replace"), "not UTF-8: read as Windows-1252"
        )
    if "\0" in text:
        msg = "holds binary data where text is expected: export it again"
        raise InputError(msg)
    return Decoded(text)


def _marked(data: bytes) -> tuple[str, bytes]:
    for mark, encoding in _BOMS:
        if data.startswith(mark):
            if not encoding:
                msg = "the text is UTF-32, which no instrument writes: save it as UTF-8"
                raise InputError(msg)
            return encoding, data[len(mark) :]
    # Exports for Windows often leave the mark out: every second byte is then zero.
    if data[1:8:2] == b"\0\0\0\0" and data[0:8:2].isascii():
        return "utf-16-le", data
    if data[0:8:2] == b"\0\0\0\0" and data[1:8:2].isascii():
        return "utf-16-be", data
    return "utf-8", data


def plain(text: object, longest: int = LONGEST_NAME) -> str:
    """A text that every file and log can carry: no control characters, not too long."""
    kept = (c for c in str(text) if unicodedata.category(c) not in {"Cc", "Cs", "Cn"})
    return " ".join("".join(kept).split())[:longest]


class Number(NamedTuple):
    """A number, and whether a percent sign stood behind it (then already divided)."""

    value: float
    is_percent: bool = False


def parse_number(text: str, *, decimal: str = ".") -> Number:
    """The number a cell holds.

    Parameters
    ----------
    decimal
        Its decimal sign, a point or a comma.

    Raises
    ------
    InputError
        When it is none; tells a decimal comma from other text.
    """
    cleaned = text.strip().translate(_DASHES)
    other = "," if decimal == "." else "."
    match = _NUMBER.fullmatch(cleaned.replace(",", ".") if decimal == "," else cleaned)
    if match is None or (decimal == "," and "." in cleaned):
        raise InputError(_number_fault(cleaned, other))
    value = float(match["body"])
    if not math.isfinite(value):
        msg = "the number is too large: correct it or export again"
        raise InputError(msg)
    percent = bool(match["percent"])
    return Number(value / 100.0 if percent else value, percent)


def _number_fault(text: str, other: str) -> str:
    if not text:
        return "a number is missing: fill it in or leave the whole row out"
    if _THOUSANDS.fullmatch(text) and len(re.findall("[.,]", text)) > 1:
        return "a number with thousands separators: write it without them"
    if other in text and _NUMBER.fullmatch(text.replace(",", ".")):
        sign = "comma" if other == "," else "point"
        return f"a decimal {sign} where the file has the other sign: write all alike"
    return "not a number: correct it or export again"
