"""ColorSnap: the known paints nearest to a target, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from paintlink.color import Formula, components
from paintlink.errors import LibraryError
from paintlink.model import AngleDifference, ColorSpec, FloatArray, Match, PaintTable
from paintlink.snap.cache import INDEXES
from paintlink.snap.conditions import Comparison, Conditions, agree, formula_of, listed
from paintlink.snap.grown import Mask
from paintlink.snap.index import Index
from paintlink.snap.scan import Ranked
from paintlink.snap.words import words


def nearest(
    spec: ColorSpec,
    table: PaintTable,
    *,
    top: int = 20,
    formula: str = "cie76",
    angles_deg: tuple[float, ...] | None = None,
    mask: Mask | None = None,
) -> tuple[Match, ...]:
    """The ``top`` paints with the smallest total difference from the target, in order.

    The total is the sum of the differences at the aspecular angles, in float64 and in
    ascending order of the angles; equal totals come in the order of the stable ids.
    The paint is the standard and the target the sample, which matters to CIE94 and
    CMC. CIE76 totals are the same bits everywhere; the other formulas use
    trigonometry or logarithms, so theirs are the same bits on one installation.

    Parameters
    ----------
    formula
        An id of `paintlink.color.FORMULAS`.
    angles_deg
        Aspecular angles to compare at. By default 15, 45 and 110; where one of them is
        missing, every angle that target and library share, at least three; where
        fewer are shared, the target's angles between the library's, at which the
        library is interpolated and the answer says so in ``estimated_deg``.
    mask
        Paints that may be returned, shape (n,). Where these are fewer than ``top``,
        fewer are returned. A paint without Lab at a compared angle is never returned.

    Raises
    ------
    LibraryError
        When target and library cannot be compared, or no paint may be returned.
    """
    (conditions,) = agree(spec, [table], angles_deg)
    return _nearest(spec, table, conditions, formula_of(formula), top=top, mask=mask)


def nearest_of_all(
    spec: ColorSpec,
    tables: Sequence[PaintTable],
    *,
    top: int = 20,
    formula: str = "cie76",
    angles_deg: tuple[float, ...] | None = None,
    masks: Sequence[Mask | None] = (),
) -> tuple[Match, ...]:
    """The nearest paints of several libraries in one list, as by `nearest`.

    All libraries are compared at the same angles. Equal totals come in the order of
    the libraries, then of the ids. A library of which no paint may be returned adds
    nothing.

    Raises
    ------
    LibraryError
        As `nearest`, and when no library has a paint that may be returned.
    """
    chosen, every = formula_of(formula), agree(spec, tables, angles_deg)
    lists: list[tuple[Match, ...]] = []
    for table, conditions, mask in zip(
        tables, every, masks or [None] * len(tables), strict=True
    ):
        if len(table) and (mask is None or mask.any()):
            found = _nearest(spec, table, conditions, chosen, top=top, mask=mask)
            lists.append(found)
    if not lists:
        msg = f"no paint of {len(tables)} libraries is left to compare with"
        raise LibraryError(f"{msg}: widen the filter")
    merged = sorted((match for one in lists for match in one), key=_total)
    ranked = enumerate(merged[:top], start=1)
    return tuple(replace(match, rank=rank) for rank, match in ranked)


def _total(match: Match) -> float:
    return match.total


def _nearest(
    spec: ColorSpec,
    table: PaintTable,
    conditions: Conditions,
    formula: Formula,
    *,
    top: int,
    mask: Mask | None,
) -> tuple[Match, ...]:
    require_paints(table, mask, top)
    index = INDEXES.of(table, conditions)
    target = spec.lab(*conditions.angles_deg)
    comparison = Comparison(target, conditions.angles_deg, formula)
    ranked = index.nearest(comparison, top, index.allowed(mask))
    if not ranked.positions.size:
        msg = f"no paint of {table.library} can be compared by {formula.label}"
        raise LibraryError(
            f"{msg} at {listed(conditions.angles_deg)} degrees: widen the filter"
        )
    return _matches(table, index, ranked, comparison)


def require_paints(table: PaintTable, mask: Mask | None, top: int) -> None:
    """Refuse a question that no paint can answer.

    Raises
    ------
    LibraryError
        When none is asked for, none may be returned, or the filter is of another size.
    """
    if top < 1:
        msg = f"asked for the {top} nearest paints: ask for at least 1"
        raise LibraryError(msg)
    if mask is not None and mask.shape != (len(table),):
        msg = (
            f"the filter was made for {mask.size} paints, but {table.library} has "
            f"{len(table)}: apply it to this library"
        )
        raise LibraryError(msg)
    if len(table) == 0 or (mask is not None and not mask.any()):
        msg = f"no paint of {table.library} is left to compare with: widen the filter"
        raise LibraryError(msg)


def _matches(
    table: PaintTable, index: Index, ranked: Ranked, comparison: Comparison
) -> tuple[Match, ...]:
    """One match for each found paint."""
    paints = index.stock.planes[..., ranked.positions].transpose(2, 0, 1)
    found = zip(
        index.stock.rows[ranked.positions].tolist(),
        ranked.totals.tolist(),
        paints,
        _differences(ranked.differences, paints, comparison),
        strict=True,
    )
    return tuple(
        Match(
            rank=rank,
            paint_id=int(table.ids[row]),
            code=table.codes[row],
            name=table.names[row],
            finish=table.finishes[row],
            total=total,
            differences=differences,
            words=words(differences, paint),
            formula=comparison.formula.id,
            angles_deg=comparison.angles_deg,
            observer=table.observer,
            library=table.library,
            generation=table.generation,
            estimated_deg=index.conditions.estimated_deg,
        )
        for rank, (row, total, paint, differences) in enumerate(found, start=1)
    )


def _differences(
    dE: FloatArray, paints: FloatArray, comparison: Comparison
) -> list[tuple[AngleDifference, ...]]:
    """Differences at every angle, target minus paint, for paints (k, angles, 3)."""
    values = np.stack([dE, *components(paints, comparison.target)], axis=-1)
    return [
        tuple(map(AngleDifference, comparison.angles_deg, *columns))
        for columns in values.transpose(0, 2, 1).tolist()
    ]
