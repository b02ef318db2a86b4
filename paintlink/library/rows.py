"""Paints in columns on their way into a library, and what is refused on that way."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import TypeVar

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
"""Paints stored together."""

READ_AT_ONCE = 512
"""Rows of a table read and checked together: as many as a processor keeps at hand."""

T = TypeVar("T")

_REFUSED = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
_REFUSED_IN_TEXT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]"
)


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


def together(parts: Sequence[Rows]) -> Rows:
    """The paints of several rows, one after the other."""
    names = dict.fromkeys(name for one in parts for name in one.extras)
    return Rows(
        codes=_chained(one.codes for one in parts),
        names=_chained(one.names for one in parts),
        finishes=_chained(one.finishes for one in parts),
        lab=np.concatenate([one.lab for one in parts]),
        gloss_gu=np.concatenate([one.gloss_gu for one in parts]),
        extras={
            name: _chained(one.extras.get(name, ("",) * len(one)) for one in parts)
            for name in names
        },
        places=_places([one.places for one in parts]),
    )


def _chained(parts: Iterable[Iterable[T]]) -> tuple[T, ...]:
    return tuple(chain.from_iterable(parts))


def _places(parts: list[Sequence[int | str]]) -> Sequence[int | str]:
    """The places of all; lines that follow on each other stay a range."""
    ranges = [one for one in parts if isinstance(one, range)]
    if len(ranges) == len(parts):
        whole = range(ranges[0].start, ranges[-1].stop)
        if len(whole) == sum(map(len, ranges)):
            return whole
    return _chained(parts)


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
    refused = _REFUSED_IN_TEXT if line_breaks else _REFUSED
    # What is printable has no control character, and is told so ten times faster.
    found = None if joined.isprintable() else refused.search(joined)
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
