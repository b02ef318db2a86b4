from __future__ import annotations

import numpy as np
import pytest

from paintlink.preview.layout import ALONE, Layout, Parts, Pattern

SPAN = (-0.5, 0.5)


def parts(pattern: Pattern, count: int, size: int = 400) -> Parts:
    row, column = np.divmod(np.arange(size * size), size)
    return Layout(pattern, count).parts(SPAN, column, row, size)


def test_columns_share_the_object_not_the_picture() -> None:
    number = parts("columns", 4).number[:400]

    assert np.flatnonzero(np.diff(number)).tolist() == [149, 199, 249]


def test_stripes_show_every_paint_several_times() -> None:
    number = parts("stripes", 2).number[:400]

    assert np.count_nonzero(np.diff(number)) == 5
    assert set(number) == {0, 1}


@pytest.mark.parametrize("count", [2, 3, 4])
def test_checker_has_unlike_neighbours_and_every_paint(count: int) -> None:
    number = parts("checker", count).number.reshape(400, 400)[100:300, 100:300]
    squares = number[12::25, 12::25]

    assert set(squares.ravel()) == set(range(count))
    assert (squares[:, 1:] != squares[:, :-1]).all()
    assert (squares[1:] != squares[:-1]).all()


@pytest.mark.parametrize("size", [16, 512, 4096])
def test_seam_is_as_wide_as_it_says(size: int) -> None:
    column = np.arange(size)

    share = Layout("columns", 2).parts(SPAN, column, 0 * column, size).share

    assert (1 - share).sum() == pytest.approx(max(1, size / 200), abs=0.01)


def test_one_paint_has_no_seam() -> None:
    column = np.arange(64)

    assert (ALONE.parts(SPAN, column, column, 64).share == 1).all()
