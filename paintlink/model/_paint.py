"""Known paints and how a target compares with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import LibraryError
from paintlink.model._base import Finish, FloatArray, Observer
from paintlink.model._spec import AngleDifference


@dataclass(frozen=True, slots=True)
class Match:
    """One known paint beside a target, with everything the numbers depend on.

    ``total`` is the sum of the differences over ``angles_deg``; differences are target
    minus paint. ``words`` says them the way a painter does. At ``estimated_deg`` the
    paint was not measured but interpolated.
    """

    rank: int
    paint_id: int
    code: str
    name: str
    finish: Finish
    total: float
    differences: tuple[AngleDifference, ...]
    words: str
    formula: str
    angles_deg: tuple[float, ...]
    observer: Observer
    library: str
    generation: str
    estimated_deg: tuple[float, ...] = ()

    @property
    def mean(self) -> float:
        """Mean difference per angle."""
        return self.total / len(self.differences)


@dataclass(frozen=True, slots=True, eq=False)
class Facet:
    """One further column of a library, such as brand, maker or year.

    Parameters
    ----------
    values
        The distinct values, sorted.
    codes
        Index into ``values`` of every paint, -1 where it has none, shape (n,).
    """

    values: tuple[str, ...]
    codes: NDArray[np.int32]

    def value(self, row: int) -> str:
        """Value of one paint, empty where it has none."""
        code = int(self.codes[row])
        return self.values[code] if code >= 0 else ""


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class PaintTable:
    """A library in memory: one row per paint, ordered by its stable id.

    Parameters
    ----------
    ids
        Stable identifiers, ascending, shape (n,).
    angles_deg
        Aspecular angles of the Lab columns, ascending, shape (m,).
    lab
        D65, shape (n, m, 3).
    facets
        Further columns by their name; some libraries read them when they are asked for.
    """

    library: str
    generation: str
    synthetic: bool
    observer: Observer
    ids: NDArray[np.int64]
    codes: tuple[str, ...]
    names: tuple[str, ...]
    finishes: tuple[Finish, ...]
    angles_deg: tuple[float, ...]
    lab: FloatArray
    gloss_gu: FloatArray | None = None
    facets: Mapping[str, Facet] = field(default_factory=dict)

    def __post_init__(self) -> None:
        rows = {len(self.ids), len(self.codes), len(self.names), len(self.finishes)}
        shape = (len(self.ids), len(self.angles_deg), 3)
        if len(rows) != 1 or self.lab.shape != shape:
            msg = f"library {self.library}: columns of different length"
            raise LibraryError(msg)

    def __len__(self) -> int:
        return len(self.codes)
