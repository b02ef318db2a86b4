"""Further columns of a library, such as brand, maker or year, as filters use them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import ConfigError, LibraryError
from paintlink.model import Facet, PaintTable

RANGE_SIGN = ".."


@dataclass(frozen=True, slots=True)
class FacetChoice:
    """A condition on one column: one of some values, or a number within limits.

    Parameters
    ----------
    column
        Name of the column, in any case.
    values
        Values that pass, in any case; ``2015..2020`` stands for the numbers from the
        one to the other, both included, with an end left out where there is no limit.
    """

    column: str
    values: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.column} {' or '.join(self.values)}"

    def mask(self, table: PaintTable) -> NDArray[np.bool_]:
        """Which paints pass, shape (n,).

        Raises
        ------
        LibraryError
            When the library has no such column; names those it has.
        """
        facet = facet_of(table, self.column)
        # One place more for paints without a value, whose code is -1: the last one.
        wanted = np.array([*map(self._takes, facet.values), False], dtype=np.bool_)
        return wanted[facet.codes]

    def _takes(self, value: str) -> bool:
        return any(_meets(value, wanted) for wanted in self.values)


def parse_choices(texts: Iterable[str]) -> tuple[FacetChoice, ...]:
    """Conditions written as ``column=value``; a column named again adds a value.

    Raises
    ------
    ConfigError
        When a text names no column.
    """
    wanted: dict[str, tuple[str, list[str]]] = {}
    for text in texts:
        name, sign, value = text.partition("=")
        if not (name.strip() and sign):
            msg = f"{text!r}: write a condition as column=value or year=2015..2020"
            raise ConfigError(msg)
        name = name.strip()
        wanted.setdefault(name.casefold(), (name, []))[1].append(value.strip())
    return tuple(FacetChoice(name, tuple(values)) for name, values in wanted.values())


def facet_of(table: PaintTable, name: str) -> Facet:
    """The column of this name, in any case.

    Raises
    ------
    LibraryError
        When the library has none; names those it has.
    """
    for known in table.facets:
        if known.casefold() == name.casefold():
            return table.facets[known]
    have = ", ".join(table.facets) or "none beside code, name and finish"
    msg = f"{table.library} has no column {name!r}; it has {have}"
    raise LibraryError(msg)


class LazyFacets(Mapping[str, Facet]):
    """Further columns that are read when they are first asked for.

    Parameters
    ----------
    columns
        How the texts of each column are had, by its name.
    """

    def __init__(self, columns: Mapping[str, Callable[[], Sequence[str]]]) -> None:
        self._columns = columns
        self._known: dict[str, Facet] = {}

    def __getitem__(self, name: str) -> Facet:
        """The column of this name."""
        if name not in self._known:
            self._known[name] = facet(self._columns[name]())
        return self._known[name]

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of this name; it is not read for that."""
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)


def facet(column: Sequence[str]) -> Facet:
    """A column of texts as a facet; empty texts are missing values."""
    seen: dict[str, int] = {"": -1}
    found = [seen.setdefault(text, len(seen) - 1) for text in column]
    unsorted = list(seen)[1:]
    order = sorted(range(len(unsorted)), key=unsorted.__getitem__)
    rank = np.full(len(seen), -1, dtype=np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    codes = rank[np.array(found, dtype=np.int64)]
    codes.setflags(write=False)
    return Facet(tuple(unsorted[index] for index in order), codes)


def _meets(value: str, wanted: str) -> bool:
    limits = _limits(wanted)
    if limits is None:
        return value.casefold() == wanted.casefold()
    try:
        return limits[0] <= float(value) <= limits[1]
    except ValueError:
        return False


def _limits(wanted: str) -> tuple[float, float] | None:
    low, sign, high = wanted.partition(RANGE_SIGN)
    if not sign:
        return None
    try:
        return float(low or -math.inf), float(high or math.inf)
    except ValueError:
        return None
