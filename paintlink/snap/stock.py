"""The paints of a library, made ready to be compared at some angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.color import default_model, fit
from paintlink.errors import LibraryError
from paintlink.model import FloatArray, PaintTable
from paintlink.snap.conditions import Conditions, listed


@dataclass(frozen=True, slots=True, eq=False)
class Stock:
    """Paints that have Lab at every compared angle; a NaN is a missing measurement.

    Parameters
    ----------
    planes
        Lab, shape (angles, 3, n), each L, a and b one run.
    ids, rows
        Stable id, and row in the table, of each paint, shape (n,).
    """

    planes: FloatArray
    ids: NDArray[np.int64]
    rows: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.rows)


def stock_of(table: PaintTable, conditions: Conditions) -> Stock:
    """The paints of a table that can be compared at the angles.

    At estimated angles each paint is interpolated between its measured ones.

    Raises
    ------
    LibraryError
        When no paint has them all.
    """
    planes = _planes(table, conditions)
    complete = np.isfinite(planes).all(axis=(0, 1))
    if len(table) and not complete.any():
        msg = (
            f"no paint of {table.library} has Lab at all of "
            f"{listed(conditions.angles_deg)} degrees: compare at other angles"
        )
        raise LibraryError(msg)
    rows = np.flatnonzero(complete)
    if len(rows) < len(table):
        planes = planes[..., rows]
    return Stock(planes, np.asarray(table.ids, dtype=np.int64)[rows], rows)


def _planes(table: PaintTable, conditions: Conditions) -> FloatArray:
    if conditions.estimated_deg:
        curve = fit(table.angles_deg, table.lab, default_model(table.angles_deg))
        lab = curve(conditions.angles_deg)
        measured = [a for a in conditions.angles_deg if a in table.angles_deg]
        for angle in measured:
            at = table.angles_deg.index(angle)
            lab[:, conditions.angles_deg.index(angle)] = table.lab[:, at]
    else:
        columns = [table.angles_deg.index(angle) for angle in conditions.angles_deg]
        lab = np.moveaxis(np.moveaxis(table.lab, 0, 2)[columns], 2, 0)
    return np.ascontiguousarray(np.moveaxis(lab, 0, 2))
