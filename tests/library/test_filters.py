from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from paintlink.color import Leaf
from paintlink.errors import LibraryError
from paintlink.library import Filter, bundled, find, indices
from paintlink.model import PaintTable


def codes(table: PaintTable, chosen: Filter) -> list[str]:
    return [table.codes[row] for row in np.flatnonzero(chosen.apply(table))]


def test_empty_filter_lets_every_paint_pass() -> None:
    assert Filter().apply(bundled()).all()


def test_check_boxes_limit_the_finish() -> None:
    table = bundled()

    passing = Filter(finishes=("solid", "pearl")).apply(table)

    assert np.array_equal(passing, np.array(table.finishes) != "metallic")


def test_leaf_holds_the_codes_of_its_drawer() -> None:
    found = codes(bundled(), Filter(leaves=(Leaf("effect", "red"),)))

    assert len(found) > 300
    assert {code[:2] for code in found} == {"RM"}


def test_several_leaves_are_taken_together() -> None:
    blues = (Leaf("solid", "blue"), Leaf("effect", "blue"))

    found = codes(bundled(), Filter(leaves=blues))

    assert {code[:2] for code in found} == {"BS", "BM"}


@pytest.mark.parametrize("index", ["flop", "hue_shift", "chroma"])
def test_range_includes_both_its_ends(index: str) -> None:
    table = bundled()
    values = getattr(indices(table), index)
    low, high = sorted(values[[find(table, "BM304"), find(table, "GM044")]])

    passing = Filter(**{index: (low, high)}).apply(table)

    assert np.array_equal(passing, (values >= low) & (values <= high))
    assert passing[[find(table, "BM304"), find(table, "GM044")]].all()


def test_undefined_index_passes_no_range() -> None:
    table = bundled()
    undefined = np.isnan(indices(table).hue_shift)

    passing = Filter(hue_shift=(-1e9, 1e9)).apply(table)

    assert undefined.any()
    assert np.array_equal(passing, ~undefined)


def test_indices_of_the_paper_are_combined() -> None:
    found = codes(bundled(), Filter(flop=(16.5, 16.7), chroma=(5.5, 5.7)))

    assert "BM304" in found


@pytest.mark.parametrize("text", ["BM304", "bm30", "harbour BLUE"])
def test_text_is_sought_in_code_and_name(text: str) -> None:
    assert "BM304" in codes(bundled(), Filter(text=text))


def test_error_names_the_filter_that_took_the_last_paint() -> None:
    table = bundled()
    pearls = table.finishes.count("pearl")

    with pytest.raises(
        LibraryError,
        match=f"none of {pearls} paints passes the filter flop index 90 to 99: widen",
    ):
        Filter(finishes=("pearl",), flop=(90.0, 99.0), text="RM").apply(table)


@pytest.mark.parametrize(
    ("chosen", "named"),
    [
        (Filter(finishes=("unknown",)), "finish unknown"),
        (
            Filter(finishes=("solid",), leaves=(Leaf("effect", "red"),)),
            "leaf effect red",
        ),
        (Filter(chroma=(5.0, 1.0)), "chroma index 5 to 1"),
        (Filter(text="no such name"), "text 'no such name'"),
    ],
)
def test_every_filter_can_be_named(chosen: Filter, named: str) -> None:
    with pytest.raises(LibraryError, match=f"passes the filter {named}: widen it"):
        chosen.apply(bundled())


def test_library_without_the_angles_cannot_be_ranged() -> None:
    table = bundled()
    three = replace(table, angles_deg=(25.0, 45.0, 75.0), lab=table.lab[:, 2:5])

    with pytest.raises(LibraryError, match="no Lab at 15 degrees, only at 25, 45, 75"):
        Filter(flop=(0.0, 20.0)).apply(three)
    assert Filter(finishes=("solid",), text="rs").apply(three).any()
