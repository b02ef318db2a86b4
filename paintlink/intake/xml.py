"""XML of unknown origin, locked down as the reader of specifications is."""

from __future__ import annotations

import re
from typing import cast

from lxml import etree

from paintlink.errors import SpecError
from paintlink.intake.source import Source
from paintlink.spec import safe_root_of_text

MAX_MARKS = 1_500_000
"""Angle brackets and equals signs: what elements and attributes cannot do without."""

MAX_ATTRIBUTES = 200

_DECLARED = re.compile(rb"""<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z0-9_.-]{1,40})""")
_LATIN = {"ISO-8859-1", "LATIN1", "LATIN-1", "WINDOWS-1252", "CP1252", "US-ASCII"}


def root_of(source: Source) -> etree._Element:
    """Root of the document; opens nothing that it names.

    Raises
    ------
    InputError
        For a type declaration, more nodes than any file of readings has, or XML that
        is not well formed.
    """
    text = _text(source)
    if text.count("<") + text.count("=") > MAX_MARKS:
        raise source.fault("", "more elements than files of readings have: split it")
    # The parser compares the attributes of one element with each other.
    if any(piece.count("=") > MAX_ATTRIBUTES for piece in text.split("<")):
        raise source.fault("", "an element with hundreds of attributes: export again")
    try:
        return safe_root_of_text(text)
    except SpecError as error:
        where = "" if error.line is None else f"line {error.line}"
        raise source.fault(where, error.what, error.value) from error


def line_of(node: etree._Element) -> str:
    """Where an element begins, for messages."""
    return f"line {cast('int | None', node.sourceline) or '?'}"


def _text(source: Source) -> str:
    found = _DECLARED.match(source.data[:200].lstrip())
    declared = found[1].decode().upper() if found else "UTF-8"
    if declared in _LATIN:
        return source.data.decode("cp1252", "replace")
    if source.decoded.note:
        msg = "not the UTF-8 it says it is: save it as UTF-8, or export again"
        raise source.fault("", msg)
    return source.text
