"""How the paints spread over an index: what is drawn behind its slider."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.library.columns import columns
from paintlink.library.filters import Filter, IndexName
from paintlink.model import FloatArray, PaintTable

BINS = 40
EVERY_PAINT = Filter()
STEPS = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
LAST_QUANTILE = 0.995
"""The slider ends here: the few paints beyond would squeeze all others together."""


@dataclass(frozen=True, slots=True)
class Histogram:
    """Numbers of paints over an index of colour travel.

    Parameters
    ----------
    edges
        Limits of the bins, one more than ``counts``.
    counts
        Paints in each bin; the upper edge belongs to the next bin, in the last bin to
        this one.
    beyond
        Paints above the last edge.
    undefined
        Paints for which the index is not defined.
    """

    index: IndexName
    edges: tuple[float, ...]
    counts: tuple[int, ...]
    beyond: int
    undefined: int


def histogram(
    table: PaintTable,
    index: IndexName,
    chosen: Filter = EVERY_PAINT,
    *,
    bins: int = BINS,
) -> Histogram:
    """Spread of the paints that pass a filter, its range of this index left aside.

    So the bars behind a slider stay where they are while the slider moves. The edges
    depend on the library alone.
    """
    values = getattr(columns(table), index)
    edges = _edges(values[np.isfinite(values)], bins)
    values = values[chosen.without(index).mask(table)]
    known = values[np.isfinite(values)]
    counts, _ = np.histogram(known, edges)
    return Histogram(
        index=index,
        edges=tuple(edges.tolist()),
        counts=tuple(counts.tolist()),
        beyond=int(np.count_nonzero(known > edges[-1])),
        undefined=len(values) - len(known),
    )


def _edges(values: FloatArray, bins: int) -> FloatArray:
    last = float(np.quantile(values, LAST_QUANTILE)) if len(values) else 0.0
    step = _round_up(last / bins)
    return step * np.arange(bins + 1, dtype=np.float64)


def _round_up(width: float) -> float:
    """The next width that reads well."""
    if width <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(width))
    return float(power * next(m for m in STEPS if m * power >= width))
