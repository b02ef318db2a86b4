"""Finding the columns of a table of paints by their headings."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from paintlink.errors import LibraryError
from paintlink.library.profile import LAB_FIELD, TEXT_FIELDS, Profile, field_of
from paintlink.model import SAMPLE_COUNTS

USUAL_ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
"""Angles that are recognised by themselves; others need a profile."""

_SYNONYMS = {
    "code": ("code", "paintcode", "colorcode", "colourcode", "farbcode"),
    "name": ("name", "colorname", "colourname", "description", "bezeichnung"),
    "finish": ("finish", "type", "quality"),
    "gloss": ("gloss", "gloss60", "glossgu", "gloss60gu"),
    "observer": ("observer",),
    "illuminant": ("illuminant", "illuminantobserver"),
    "origin": ("origin",),
}
_FIELDS = {word: field for field, words in _SYNONYMS.items() for word in words}
_LETTER_FIRST = re.compile(r"([lab])(?:45as)?(-?|m)(\d+)")
_ANGLE_FIRST = re.compile(r"(?:45as)?(-?|m)(\d+)([lab])")


@dataclass(frozen=True, slots=True)
class Layout:
    """Which column of a table holds what.

    Parameters
    ----------
    lab
        Column of L, a and b at each angle.
    texts
        Column of each field that is there, see `profile.TEXT_FIELDS`.
    extras
        All other columns by their heading.
    """

    width: int
    angles_deg: tuple[float, ...]
    lab: tuple[tuple[int, int, int], ...]
    texts: Mapping[str, int]
    extras: Mapping[str, int]


def layout(headings: Sequence[str], profile: Profile) -> Layout:
    """The columns of a table with these headings.

    Raises
    ------
    LibraryError
        When a column is missing, stands twice, or is named but not there.
    """
    headings = [heading.strip() for heading in headings]
    columns = _columns(headings, profile)
    if "code" not in columns:
        msg = f"no column holds the code; there are {_listed(headings)}: {_advice()}"
        raise LibraryError(msg)
    angles = _angles(columns, headings)
    taken = set(columns.values())
    extras = {
        heading: place
        for place, heading in enumerate(headings)
        if place not in taken and heading
    }
    return Layout(
        width=len(headings),
        angles_deg=angles,
        lab=tuple(_triple(columns, angle) for angle in angles),
        texts={name: columns[name] for name in TEXT_FIELDS if name in columns},
        extras=extras,
    )


def _columns(headings: list[str], profile: Profile) -> dict[str, int]:
    """Place of each field; what the profile names goes before what is recognised."""
    twice = [text for text, count in Counter(headings).items() if text and count > 1]
    if twice:
        msg = f"the heading {twice[0]!r} stands twice: rename one of the two columns"
        raise LibraryError(msg)
    columns = {}
    for name, heading in profile.columns.items():
        if heading not in headings:
            msg = (
                f"no column is called {heading!r}, named for {name}; there are "
                f"{_listed(headings)}"
            )
            raise LibraryError(msg)
        columns[_spelled(name)] = headings.index(heading)
    named = set(columns.values())
    for place, heading in enumerate(headings):
        name = _recognised(heading)
        if name and place not in named and name not in columns:
            columns[name] = place
    return columns


def _spelled(name: str) -> str:
    found = LAB_FIELD.fullmatch(name)
    return field_of(found[1], float(found[2])) if found else name


def _recognised(heading: str) -> str:
    plain = re.sub(r"[\s_()*°:;./]", "", heading).casefold()
    if plain in _FIELDS:
        return _FIELDS[plain]
    first, last = _LETTER_FIRST.fullmatch(plain), _ANGLE_FIRST.fullmatch(plain)
    if first:
        letter, sign, digits = first.groups()
    elif last:
        sign, digits, letter = last.groups()
    else:
        return ""
    angle = float(digits) * (-1.0 if sign else 1.0)
    letter = "L" if letter == "l" else letter
    return field_of(letter, angle) if angle in USUAL_ANGLES_DEG else ""


def _angles(columns: dict[str, int], headings: list[str]) -> tuple[float, ...]:
    found = (LAB_FIELD.fullmatch(name) for name in columns)
    angles = tuple(sorted({float(one[2]) for one in found if one}))
    for angle in angles:
        for letter in "Lab":
            if field_of(letter, angle) not in columns:
                msg = f"no column holds {letter} at {angle:g} degrees: {_advice()}"
                raise LibraryError(msg)
    if len(angles) not in SAMPLE_COUNTS:
        have = ", ".join(f"{angle:g}" for angle in angles) or "none"
        msg = (
            f"Lab is needed at 3, 5 or 6 aspecular angles; the headings "
            f"{_listed(headings)} give {have}: {_advice()}"
        )
        raise LibraryError(msg)
    return angles


def _triple(columns: dict[str, int], angle: float) -> tuple[int, int, int]:
    lightness, a, b = (columns[field_of(letter, angle)] for letter in "Lab")
    return lightness, a, b


def _listed(headings: list[str]) -> str:
    return ", ".join(map(repr, headings[:12])) + (", ..." if headings[12:] else "")


def _advice() -> str:
    return 'name it, as in --map code="Paint No" or --map L15="L* 15"'
