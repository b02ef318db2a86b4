"""Geometry codes in every spelling met in files."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache

from paintlink.errors import InputError
from paintlink.instrument import parse_geometry, quoted
from paintlink.model import Geometry

_DASHES = str.maketrans({"\u2212": "-", "\u2013": "-", "\u00b1": ""})
_FILLERS = re.compile(r"[\s\u00b0_]+|deg(?:rees?)?\b", re.IGNORECASE)
_BARE = re.compile(r"[-+]?\d{1,3}(?:\.\d+)?", re.ASCII)
# Lamp and detector at 45 and 0 degrees in either order: seen 45 degrees off the gloss.
_NORMAL = re.compile(r"45[:/]0[a-z]?|0[:/]45[a-z]?|45/?n|45_0", re.IGNORECASE)
_SPHERE = re.compile(r"sphere|sp[ie]n|sc[ie]|d[:/]?[08]|[08][:/]d|\d+d", re.IGNORECASE)
_SIDE = re.compile(
    r"[\s_(-]*(?<![A-Za-z])(dp|left|right)(?![A-Za-z])\)?", re.IGNORECASE
)


@lru_cache(maxsize=4096)
def read_geometry(code: str) -> Geometry:
    """The geometry of a code, which keeps its original spelling.

    Besides `parse_geometry`: degree signs, blanks, typographic minus signs, ``45/0``
    and ``0:45``, and a bare angle such as ``-15``, which is aspecular under 45 degrees.

    Raises
    ------
    InputError
        When it stands for no directional geometry.
    """
    cleaned = _FILLERS.sub("", _SIDE.sub("", code).translate(_DASHES))
    if _NORMAL.fullmatch(cleaned) or _NORMAL.fullmatch(code.strip()):
        return Geometry(45.0, code=code)
    if _SPHERE.fullmatch(cleaned):
        msg = (
            f"geometry {quoted(code)} is diffuse, a specification needs directions: "
            "export the multi-angle values, or declare a solid with --geometry 45as45"
        )
        raise InputError(msg)
    text = f"45as{cleaned}" if _BARE.fullmatch(cleaned) else cleaned
    try:
        return replace(parse_geometry(text), code=code)
    except InputError as error:
        msg = str(error).replace(quoted(text), quoted(code))
        raise InputError(msg) from error


def side_of(code: str) -> str:
    """``dp``, ``left`` or ``right`` where an instrument measures an angle twice."""
    match = _SIDE.search(code)
    return match[1].lower() if match else ""
