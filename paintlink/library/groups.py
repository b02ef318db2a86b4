"""Variants of a paint: the prime of its group and the others around it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.color import cie76
from paintlink.library.facets import facet_of
from paintlink.model import PaintTable

GROUP, VARIANT, PRIME = "group", "variant", "prime"


@dataclass(frozen=True, slots=True)
class Member:
    """A paint of a group beside the prime of the group.

    ``differences`` are CIE76 at the angles of the library, 0 for the prime itself.
    """

    row: int
    variant: str
    differences: tuple[float, ...]


def members(table: PaintTable, row: int) -> tuple[Member, ...]:
    """The group of a paint, its prime first; empty when the paint stands alone.

    Read from the columns ``group`` and ``variant``. The prime is the paint whose
    variant is ``prime`` or empty, else the one of the smallest id.
    """
    if GROUP not in {name.casefold() for name in table.facets}:
        return ()
    groups = facet_of(table, GROUP).codes
    rows = np.flatnonzero(groups == groups[row]) if groups[row] >= 0 else np.array([])
    if len(rows) < 2:
        return ()
    variants = {int(one): _variant(table, int(one)) for one in rows}
    prime = min(variants, key=lambda one: (variants[one] not in {"", PRIME}, one))
    return tuple(
        Member(
            one,
            PRIME if one == prime else variants[one],
            tuple(cie76(table.lab[prime], table.lab[one]).tolist()),
        )
        for one in sorted(variants, key=lambda one: (one != prime, one))
    )


def _variant(table: PaintTable, row: int) -> str:
    if VARIANT not in {name.casefold() for name in table.facets}:
        return ""
    return facet_of(table, VARIANT).value(row)
