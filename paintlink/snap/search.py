"""ColorSnap: the known paints nearest to a target, exactly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.color import components
from paintlink.errors import LibraryError
from paintlink.model import AngleDifference, ColorSpec, FloatArray, Match, PaintTable
from paintlink.snap import scan
from paintlink.snap.conditions import Comparison, agree
from paintlink.snap.words import words


def nearest(
    spec: ColorSpec,
    table: PaintTable,
    *,
    top: int = 20,
    formula: str = "cie76",
    angles_deg: tuple[float, ...] | None = None,
    mask: NDArray[np.bool_] | None = None,
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
        missing, every angle that target and library share, at least three.
    mask
        Paints that may be returned, shape (n,). Where these are fewer than ``top``,
        fewer are returned.

    Raises
    ------
    LibraryError
        When target and library cannot be compared, or no paint may be returned.
    """
    if top < 1:
        msg = f"asked for the {top} nearest paints: ask for at least 1"
        raise LibraryError(msg)
    comparison = agree(spec, table, formula, angles_deg)
    rows = _allowed(table, mask)
    columns = [table.angles_deg.index(angle) for angle in comparison.angles_deg]
    total = scan.totals([table.lab[rows, column] for column in columns], comparison)
    best = scan.first(total, table.ids[rows], top)
    return _matches(table, np.arange(len(table))[rows][best], total[best], comparison)


def _allowed(
    table: PaintTable, mask: NDArray[np.bool_] | None
) -> slice | NDArray[np.int64]:
    """Rows that may be returned, ascending; a slice costs no copy of the library."""
    if mask is not None and mask.shape != (len(table),):
        msg = (
            f"the filter was made for {mask.size} paints, but {table.library} has "
            f"{len(table)}: apply it to this library"
        )
        raise LibraryError(msg)
    if len(table) == 0 or (mask is not None and not mask.any()):
        msg = f"no paint of {table.library} is left to compare with: widen the filter"
        raise LibraryError(msg)
    return slice(None) if mask is None else np.flatnonzero(mask)


def _matches(
    table: PaintTable,
    rows: NDArray[np.int64],
    totals: FloatArray,
    comparison: Comparison,
) -> tuple[Match, ...]:
    """One match for each row, which are already in order."""
    columns = [table.angles_deg.index(angle) for angle in comparison.angles_deg]
    paints = table.lab[rows][:, columns]
    found = zip(
        rows.tolist(),
        totals.tolist(),
        paints,
        _differences(paints, comparison),
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
        )
        for rank, (row, total, paint, differences) in enumerate(found, start=1)
    )


def _differences(
    paints: FloatArray, comparison: Comparison
) -> list[tuple[AngleDifference, ...]]:
    """Differences at every angle, target minus paint, for paints (k, angles, 3)."""
    target, angles = comparison.target, comparison.angles_deg
    dE = comparison.formula(paints, target, angles)
    values = np.stack([dE, *components(paints, target)], axis=-1)
    return [
        tuple(map(AngleDifference, angles, *columns))
        for columns in values.transpose(0, 2, 1).tolist()
    ]
