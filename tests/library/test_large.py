"""A million rows, and every moment an import can be killed at: minutes, so a proof."""

from __future__ import annotations

import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from paintlink.errors import ImportRefusedError, LibraryStoreError
from paintlink.library import Shelf
from paintlink.library.csv_file import read_csv
from tests.library.csv_tables import HEADINGS, Row, a_row, rows, write_csv
from tests.library.test_harm import importing, unharmed

pytestmark = pytest.mark.proof

MILLION = 1_000_000
KILLS = 25


def a_million_rows() -> Iterator[Row]:
    some = [a_row(number)[1:] for number in range(1000)]
    for number in range(MILLION):
        yield [f"C{number:07d}", *some[number % 1000]]


@pytest.fixture
def shelf(tmp_path: Path) -> Shelf:
    shelf = Shelf(tmp_path / "library.db")
    small = read_csv(write_csv(tmp_path / "small.csv", rows(10)))
    shelf.editor.import_paints("Shop", small)
    return shelf


@pytest.mark.timeout(600)
def test_one_bad_row_of_a_million_is_found(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "large.csv", a_million_rows())
    text = path.read_text()
    bad = text.index("C0765432")
    path.write_text(f"{text[:bad]}{text[bad:].replace(',', ',,', 1)}")

    with pytest.raises(ImportRefusedError) as caught:
        read_csv(path)

    (found,) = caught.value.refusals
    assert str(found) == (
        f"line 765434: it has {len(HEADINGS) + 1} cells where the heading has "
        f"{len(HEADINGS)}"
    )


@pytest.mark.timeout(600)
def test_import_killed_at_any_moment_is_whole_or_was_not(
    shelf: Shelf, tmp_path: Path
) -> None:
    large = write_csv(tmp_path / "large.csv", rows(20_000))
    rng = random.Random(4)
    usual_s = stored_within(shelf, large, None)
    assert len(shelf.table("Shop")) == 20_000
    shelf.editor.undo("Shop")
    for _ in range(KILLS):
        stored_within(shelf, large, rng.uniform(0.0, 1.2 * usual_s))
        if len(shelf.table("Shop")) == 20_000:
            shelf.editor.undo("Shop")
        assert unharmed(shelf)


def stored_within(shelf: Shelf, table: Path, limit_s: float | None) -> float:
    """Import in another process, killed at the limit; how long it was storing."""
    with importing(shelf, table) as process:
        assert process.stdin
        assert process.stdout
        process.stdout.readline()
        start = time.monotonic()
        process.stdin.write("\n" * 99)
        process.stdin.flush()
        try:
            process.wait(limit_s)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        process.communicate()
        return time.monotonic() - start


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 1 MiB."""
    place = tmp_path / "disk"
    place.mkdir()
    if not sys.platform.startswith("linux") or not shutil.which("mount"):
        pytest.skip("a small file system needs mount")
    command = ["mount", "-t", "tmpfs", "-o", "size=1m", "paintlink-test", str(place)]
    if subprocess.run(command, check=False, capture_output=True).returncode:
        pytest.skip("a small file system needs root")
    yield place
    subprocess.run(["umount", "-l", str(place)], check=True)


def test_really_full_disk_leaves_the_library_as_it_was(
    small_disk: Path, tmp_path: Path
) -> None:
    shelf = Shelf(small_disk / "library.db")
    small = read_csv(write_csv(tmp_path / "small.csv", rows(10)))
    shelf.editor.import_paints("Shop", small)
    large = read_csv(write_csv(tmp_path / "large.csv", rows(20_000)))

    with pytest.raises(LibraryStoreError, match="is full; free disk space"):
        shelf.editor.import_paints("Shop", large, "update")

    assert unharmed(shelf)
    shelf.editor.rename("Shop", "Still works")
    assert len(shelf.table("Still works")) == 10
