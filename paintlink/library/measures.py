"""What can be said about every paint of a library at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.color import LEAVES, Leaf
from paintlink.library.columns import columns
from paintlink.model import FINISHES, Finish, FloatArray, PaintTable

USUAL_FLOP_LIMIT = 20.0
"""The paper: over 96 % of colours have a flop index between 0 and this."""

STEEP_FLOP_LIMIT = 25.0
"""The paper: beyond this mostly very dark colours, where the index is unstable."""


@dataclass(frozen=True, slots=True, eq=False)
class Indices:
    """Indices of colour travel, one value per paint, NaN where undefined."""

    flop: FloatArray
    hue_shift: FloatArray
    chroma: FloatArray


@dataclass(frozen=True, slots=True)
class Statistics:
    """How many paints of which kind, and how much the effect paints flop.

    ``mean_flop_index`` and ``usual_flop_share`` leave solids out, and paints whose
    flop index is undefined; they are None when none is left.
    """

    paints: int
    by_finish: dict[Finish, int]
    by_leaf: dict[Leaf, int]
    mean_flop_index: float | None
    usual_flop_share: float | None
    steep_flop_paints: int


def indices(table: PaintTable) -> Indices:
    """Flop, hue shift and chroma index of every paint."""
    known = columns(table)
    return Indices(flop=known.flop, hue_shift=known.hue_shift, chroma=known.chroma)


def leaves(table: PaintTable) -> NDArray[np.int8]:
    """Index into `paintlink.color.LEAVES` of every paint, -1 for unknown finishes."""
    return columns(table).leaves


def statistics(table: PaintTable) -> Statistics:
    """Counts by finish and leaf, and the flop index of the effect paints."""
    effect = ~columns(table).where("solid")
    flop = indices(table).flop[effect]
    flop = flop[np.isfinite(flop)]
    drawers = leaves(table)
    return Statistics(
        paints=len(table),
        by_finish={finish: table.finishes.count(finish) for finish in FINISHES},
        by_leaf={
            leaf: int(np.count_nonzero(drawers == index))
            for index, leaf in enumerate(LEAVES)
        },
        mean_flop_index=_mean(flop),
        usual_flop_share=_mean(flop <= USUAL_FLOP_LIMIT),
        steep_flop_paints=int(np.count_nonzero(flop > STEEP_FLOP_LIMIT)),
    )


def _mean(values: FloatArray | NDArray[np.bool_]) -> float | None:
    return float(values.mean()) if len(values) else None
