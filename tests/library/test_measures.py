from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import LEAVES, chroma_index, flop_index, hue_shift_index, leaf
from paintlink.library import bundled, indices, leaves, paint_spec, statistics


@pytest.mark.parametrize("row", [0, 1717, 2999, 3000, 4444, 5999])
def test_indices_equal_those_of_the_specification(row: int) -> None:
    table = bundled()
    lab = paint_spec(table, row).lab(15.0, 45.0, 110.0)

    found = indices(table)

    assert found.flop[row] == flop_index(lab)
    assert found.chroma[row] == chroma_index(lab)
    shift = hue_shift_index(lab)
    expected = np.nan if shift is None else shift
    assert np.array_equal(found.hue_shift[row], expected, equal_nan=True)


@pytest.mark.parametrize("row", [0, 1717, 2999, 3000, 4444, 5999])
def test_leaf_equals_that_of_the_specification(row: int) -> None:
    table = bundled()
    spec = paint_spec(table, row)

    assert LEAVES[leaves(table)[row]] == leaf(spec.lab(45.0)[0], spec.finish)


def test_statistics_leave_out_what_is_undefined() -> None:
    table = bundled()
    lab = np.array(table.lab)
    lab[3000:, :, 0] = [[90.0, 80.0, 70.0, 60.0, 50.0, 40.0]]
    lab[4500:, 3, 0] = -1.0

    found = statistics(replace(table, lab=lab))

    assert found.mean_flop_index == pytest.approx(
        2.69 * (80.0 - 40.0) ** 1.11 / 60.0**0.86
    )
    assert (found.usual_flop_share, found.steep_flop_paints) == (1.0, 0)
