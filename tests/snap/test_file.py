"""Trees in files: read back bit by bit, and refused rather than believed."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest

from paintlink.color import FORMULAS
from paintlink.errors import IndexFileError
from paintlink.model import PaintTable
from paintlink.snap.cache import Indexes
from paintlink.snap.conditions import Comparison, Conditions
from paintlink.snap.file import Key, content_of, read_tree, write_tree
from paintlink.snap.index import Index, tree_of
from paintlink.snap.stock import stock_of
from tests.snap.conftest import STANDARD, make_table
from tests.snap.oracle import paints

AT = Conditions(STANDARD)
CIE76 = FORMULAS["cie76"]


@pytest.fixture
def table() -> PaintTable:
    return make_table(paints(np.random.default_rng(1), 900, 3))


@pytest.fixture
def key(table: PaintTable) -> Key:
    return Key("Test book", "gen-1", AT, "lab", content_of(stock_of(table, AT)))


@pytest.fixture
def path(tmp_path: Path, table: PaintTable, key: Key) -> Path:
    path = tmp_path / "tree.snap"
    write_tree(path, tree_of(stock_of(table, AT), CIE76), key)
    return path


def test_tree_is_read_back_in_every_bit(
    path: Path, table: PaintTable, key: Key
) -> None:
    built, read = tree_of(stock_of(table, AT), CIE76), read_tree(path, key)

    assert isinstance(read.points.base, np.memmap)
    for one, other in (
        (built.points, read.points),
        (built.rows, read.rows),
        (built.upper.low, read.upper.low),
        (built.leaves.high, read.leaves.high),
    ):
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other)


def test_same_library_gives_the_same_bytes(
    path: Path, table: PaintTable, key: Key, tmp_path: Path
) -> None:
    write_tree(tmp_path / "again.snap", tree_of(stock_of(table, AT), CIE76), key)

    assert path.read_bytes() == (tmp_path / "again.snap").read_bytes()


def test_every_damaged_byte_is_noticed(path: Path, key: Key) -> None:
    whole = path.read_bytes()
    rng = np.random.default_rng(2)
    covered = [*range(16), *rng.integers(24, len(whole), 300).tolist()]
    believed = []
    for at in covered:
        flipped = bytearray(whole)
        flipped[at] ^= 0x40
        path.write_bytes(flipped)
        if not refused(path, key):
            believed.append(at)

    # Only the zeros between the arrays hold nothing.
    assert {whole[at] for at in believed} <= {0}
    assert len(believed) < 0.1 * len(covered)


def refused(path: Path, key: Key) -> bool:
    try:
        read_tree(path, key)
    except IndexFileError:
        return True
    return False


@pytest.mark.parametrize("length", [0, 3, 23, 24, 500, 20_000])
def test_file_cut_short_is_refused(path: Path, key: Key, length: int) -> None:
    path.write_bytes(path.read_bytes()[:length])

    with pytest.raises(IndexFileError, match=r"tree\.snap .* it is built anew"):
        read_tree(path, key)


def test_something_else_is_refused(path: Path, key: Key) -> None:
    path.write_bytes(b"PK\x03\x04 this is a zip file, or so it says")

    with pytest.raises(IndexFileError, match="starts with"):
        read_tree(path, key)


@pytest.mark.parametrize(
    "other",
    [
        Key("Test book", "gen-2", AT, "lab", ""),
        Key("Other book", "gen-1", AT, "lab", ""),
        Key("Test book", "gen-1", Conditions((15.0, 45.0, 75.0)), "lab", ""),
        Key("Test book", "gen-1", AT, "din99", ""),
    ],
)
def test_tree_of_another_state_is_stale(path: Path, other: Key) -> None:
    with pytest.raises(IndexFileError, match="is of another state"):
        read_tree(path, other)


def nearest_three(table: PaintTable, index: Index) -> list[int]:
    comparison = Comparison(table.lab[17] + 0.2, STANDARD, CIE76)
    return index.descend(comparison, 3, None).positions.tolist()


def test_next_process_reads_what_the_first_wrote(
    tmp_path: Path, table: PaintTable
) -> None:
    folder = tmp_path / "indexes"
    expected = nearest_three(table, Indexes().of(table, AT))

    first = Indexes(folder).of(table, AT)
    assert nearest_three(table, first) == expected
    (file,) = folder.iterdir()
    second = Indexes(folder).of(table, AT)

    assert nearest_three(table, second) == expected
    points = second.grown(CIE76).tree.points
    assert isinstance(points.base, np.memmap)
    assert Path(str(points.base.filename)) == file


def test_damaged_file_is_built_anew_and_told(
    tmp_path: Path, table: PaintTable, caplog: pytest.LogCaptureFixture
) -> None:
    expected = nearest_three(table, Indexes(tmp_path).of(table, AT))
    (file,) = tmp_path.iterdir()
    sound = file.read_bytes()
    file.write_bytes(sound[:-1] + b"\x55")
    file.write_bytes(sound[: len(sound) // 2])

    with caplog.at_level(logging.WARNING):
        found = nearest_three(table, Indexes(tmp_path).of(table, AT))

    assert found == expected
    assert file.read_bytes() == sound
    assert "it is built anew" in caplog.text


def test_reused_generation_does_not_mislead(tmp_path: Path, table: PaintTable) -> None:
    nearest_three(table, Indexes(tmp_path).of(table, AT))
    reversed_table = make_table(table.lab[::-1].copy())

    found = nearest_three(reversed_table, Indexes(tmp_path).of(reversed_table, AT))

    assert found == nearest_three(reversed_table, Indexes().of(reversed_table, AT))


def test_folder_that_cannot_be_written_only_costs_time(
    tmp_path: Path, table: PaintTable, caplog: pytest.LogCaptureFixture
) -> None:
    in_the_way = tmp_path / "file"
    in_the_way.write_bytes(b"")

    found = nearest_three(table, Indexes(in_the_way / "below").of(table, AT))

    assert found == nearest_three(table, Indexes().of(table, AT))
    assert "searching goes on without it" in caplog.text
