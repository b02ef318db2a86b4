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
    planes = lab_at(table, conditions.angles_deg).transpose(1, 2, 0)
    planes = np.ascontiguousarray(planes)
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


def lab_at(table: PaintTable, angles_deg: tuple[float, ...]) -> FloatArray:
    """Lab of all paints at some angles, shape (n, angles, 3).

    Interpolated where the table was not measured; the others keep their bits.
    """
    columns = [i for i, angle in enumerate(angles_deg) if angle in table.angles_deg]
    measured = [table.angles_deg.index(angles_deg[i]) for i in columns]
    if len(columns) == len(angles_deg):
        return table.lab[:, measured]
    curve = fit(table.angles_deg, table.lab, default_model(table.angles_deg))
    lab = curve(angles_deg)
    lab[:, columns] = table.lab[:, measured]
    return lab
