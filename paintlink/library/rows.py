"""Paints in columns on their way into a library, and what is refused on that way."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from paintlink.model import (
    AB_RANGE,
    FINISHES,
    GLOSS_RANGE_GU,
    L_RANGE,
    Finish,
    FloatArray,
    Observer,
)

MAX_CODE = 64
MAX_NAME = 200
MAX_TEXT = 100_000
BLOCK_PAINTS = 4096
"""Paints read, checked and stored together."""

_REFUSED = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")


@dataclass(frozen=True, slots=True, kw_only=True)
class Conditions:
    """What all paints of one library have in common.

    ``angles_deg`` are the aspecular angles of the Lab columns, ascending. Lab is D65
    under 45 degree light. ``synthetic`` paints are invented.
    """

    angles_deg: tuple[float, ...]
    observer: Observer = "10"
    synthetic: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """Some paints in columns.

    Parameters
    ----------
    lab
        D65, shape (n, angles, 3).
    gloss_gu
        At 60 degrees, NaN where unknown, shape (n,).
    extras
        Further columns of texts by their name, empty where unknown.
    places
        Where each paint was read: a line number or the name of a file.
    """

    codes: tuple[str, ...]
    names: tuple[str, ...]
    finishes: tuple[Finish, ...]
    lab: FloatArray
    gloss_gu: FloatArray
    extras: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    places: Sequence[int | str] = ()

    def __len__(self) -> int:
        return len(self.codes)


class RowError(Exception):
    """Some of the rows at hand are refused; the text fits when it is one row."""


def check(rows: Rows, angles_deg: tuple[float, ...]) -> Rows:
    """The same rows.

    Raises
    ------
    RowError
        When one of them cannot be a paint.
    """
    _check_texts("the code", rows.codes, MAX_CODE)
    _check_texts("the name", rows.names, MAX_NAME)
    for column, texts in rows.extras.items():
        _check_texts(column, texts, MAX_TEXT, line_breaks=True)
    if not all(rows.codes):
        msg = "it has no code: give every paint one"
        raise RowError(msg)
    for finish in set(rows.finishes) - set(FINISHES):
        msg = f"the finish must be one of {', '.join(FINISHES)} (found {finish!r})"
        raise RowError(msg)
    _check_numbers(rows, angles_deg)
    return rows


def _check_texts(
    what: str, texts: tuple[str, ...], longest: int, *, line_breaks: bool = False
) -> None:
    joined = "".join(texts)
    if line_breaks:
        joined = joined.translate({9: None, 10: None, 13: None})
    found = _REFUSED.search(joined)
    if found:
        msg = f"{what} holds the control character {found[0]!r}: remove it"
        raise RowError(msg)
    length = max(map(len, texts), default=0)
    if length > longest:
        msg = f"{what} is longer than {longest} characters (found {length})"
        raise RowError(msg)


def _check_numbers(rows: Rows, angles_deg: tuple[float, ...]) -> None:
    for place, angle in enumerate(angles_deg):
        for channel, (letter, limits) in enumerate((
            ("L", L_RANGE),
            ("a", AB_RANGE),
            ("b", AB_RANGE),
        )):
            values = rows.lab[:, place, channel]
            _check_range(f"{letter} at {angle:g} degrees", values, limits)
    known = rows.gloss_gu[~np.isnan(rows.gloss_gu)]
    _check_range("the gloss", known, GLOSS_RANGE_GU)


def _check_range(what: str, values: FloatArray, limits: tuple[float, float]) -> None:
    # Written so that NaN fails as well.
    wrong = ~((values >= limits[0]) & (values <= limits[1]))
    if wrong.any():
        msg = (
            f"{what} must lie between {limits[0]:g} and {limits[1]:g} "
            f"(found {values[wrong][0]:g}): check the units and the order of columns"
        )
        raise RowError(msg)
