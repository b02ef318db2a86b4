from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.library import INDEX_NAMES, Filter, bundled, histogram, indices
from paintlink.library.filters import IndexName


@pytest.mark.parametrize("index", INDEX_NAMES)
def test_every_paint_is_counted_once(index: IndexName) -> None:
    found = histogram(bundled(), index)

    assert sum(found.counts) + found.beyond + found.undefined == 6000
    assert len(found.edges) == len(found.counts) + 1


def test_bars_count_the_values_between_their_edges() -> None:
    flop = indices(bundled()).flop

    found = histogram(bundled(), "flop", bins=10)

    expected = [
        np.count_nonzero((flop >= low) & (flop < high))
        for low, high in zip(found.edges, found.edges[1:], strict=False)
    ]
    assert list(found.counts) == expected
    assert found.beyond == np.count_nonzero(flop > found.edges[-1]) > 0


def test_bars_stay_while_their_own_slider_moves() -> None:
    wide = histogram(bundled(), "flop", Filter(finishes=("pearl",)))
    narrow = histogram(bundled(), "flop", Filter(("pearl",), flop=(3.0, 4.0)))

    assert wide == narrow
    assert sum(wide.counts) + wide.beyond == bundled().finishes.count("pearl")


def test_bars_follow_the_other_sliders() -> None:
    table = bundled()
    limits = Filter(chroma=(10.0, 20.0))

    found = histogram(table, "flop", limits)

    assert sum(found.counts) + found.beyond == np.count_nonzero(limits.apply(table))
    assert found.edges == histogram(table, "flop").edges


def test_undefined_indices_are_counted_apart() -> None:
    found = histogram(bundled(), "hue_shift")

    undefined = np.isnan(indices(bundled()).hue_shift)
    assert found.undefined == np.count_nonzero(undefined) > 0


def test_library_of_one_colour_has_edges_all_the_same() -> None:
    table = bundled()
    grey = replace(table, lab=np.full_like(table.lab, 30.0))

    found = histogram(grey, "flop")

    assert found.counts[0] == 6000
    assert found.edges[:2] == (0.0, 1.0)
