"""Lists for every row of a table of targets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from paintlink.model import ColorSpec, FloatArray, PaintTable
from paintlink.snap.answer import Options
from paintlink.snap.batch import Question, nearest_many
from paintlink.snap.cache import INDEXES
from paintlink.snap.conditions import agree, formula_of, listed
from paintlink.snap.grown import Mask
from paintlink.snap.scan import Ranked
from paintlink.snap.search import require_paints


def nearest_rows(
    first: ColorSpec,
    lab: Sequence[FloatArray],
    table: PaintTable,
    options: Options,
    mask: Mask | None = None,
) -> Iterator[list[dict[str, Any]]]:
    """The list of each target, one document a paint, in the order of the targets.

    Parameters
    ----------
    first
        A specification with the angles and the observer of all targets.
    lab
        Their Lab in blocks of shape (n, angles, 3).

    Raises
    ------
    LibraryError
        As `paintlink.snap.nearest`.
    """
    (conditions,) = agree(first, [table], options.angles_deg)
    require_paints(table, mask, options.top)
    index = INDEXES.of(table, conditions)
    columns = [first.angles_deg.index(angle) for angle in conditions.angles_deg]
    targets = np.concatenate([block[:, columns] for block in lab])
    question = Question(formula_of(options.formula), options.top, index.allowed(mask))
    same = {
        "formula": options.formula,
        "estimated_deg": listed(conditions.estimated_deg)
        if (conditions.estimated_deg)
        else "",
        "library": table.library,
        "generation": table.generation,
    }
    headings = [f"dE_{angle:g}" for angle in conditions.angles_deg]

    def _documents(ranked: Ranked) -> list[dict[str, Any]]:
        rows = index.stock.rows[ranked.positions].tolist()
        found = zip(
            rows, ranked.totals.tolist(), ranked.differences.tolist(), strict=True
        )
        return [
            {
                "rank": rank,
                "code": table.codes[row],
                "total": total,
                **dict(zip(headings, at_angles, strict=True)),
                **same,
            }
            for rank, (row, total, at_angles) in enumerate(found, start=1)
        ]

    return map(_documents, nearest_many(index, targets, question))
