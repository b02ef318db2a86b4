"""What a kill, a full disk or a damaged file does to the stored libraries: nothing."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import LibraryStoreError
from paintlink.library.csv_file import read_csv
from paintlink.library.database import writing
from paintlink.library.shelf import Shelf
from tests.library.csv_tables import rows, write_csv

PAINTS = 9000
IMPORT = """
import resource, sys
from pathlib import Path
from paintlink.errors import LibraryStoreError
from paintlink.library.csv_file import read_csv
from paintlink.library.editing import Editor

state, table, limit = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
incoming = read_csv(table)
if limit:
    import signal
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

def told(share):
    print(share, flush=True)
    sys.stdin.readline()

try:
    Editor(state).import_paints("Shop", incoming, "update", progress=told)
except LibraryStoreError as error:
    sys.exit(f"{error.exit_code} {error}")
print("done", flush=True)
"""


@pytest.fixture
def shelf(tmp_path: Path) -> Shelf:
    """A shelf with a small library."""
    shelf = Shelf(tmp_path / "library.db")
    small = read_csv(write_csv(tmp_path / "small.csv", rows(10)))
    shelf.editor.import_paints("Shop", small)
    return shelf


@pytest.fixture
def large(tmp_path: Path) -> Path:
    """A table with more paints than fit into one block."""
    return write_csv(tmp_path / "large.csv", rows(PAINTS))


def importing(shelf: Shelf, table: Path, limit: int = 0) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", IMPORT, shelf.own.path, table, str(limit)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True,
    )  # fmt: skip


def unharmed(shelf: Shelf) -> bool:
    table = shelf.table("Shop")
    with sqlite3.connect(shelf.own.path) as connection:
        (verdict,) = connection.execute("PRAGMA integrity_check").fetchone()
    connection.close()
    return verdict == "ok" and table.codes == tuple(row[0] for row in rows(10))


@pytest.mark.parametrize("steps", [1, 2, 3, 4])
def test_killed_import_leaves_the_library_as_it_was(
    shelf: Shelf, large: Path, steps: int
) -> None:
    with importing(shelf, large) as process:
        assert process.stdin
        assert process.stdout
        for step in range(steps):
            assert process.stdout.readline()
            if step < steps - 1:
                process.stdin.write("\n")
                process.stdin.flush()
        process.send_signal(signal.SIGKILL)
        process.communicate()

    assert unharmed(shelf)
    shelf.editor.import_paints("Shop", read_csv(large), "update")
    assert len(shelf.table("Shop")) == PAINTS


@pytest.mark.parametrize("limit", [20_000, 400_000, 900_000])
def test_full_disk_leaves_the_library_as_it_was(
    shelf: Shelf, large: Path, limit: int
) -> None:
    with importing(shelf, large, limit) as process:
        _, said = process.communicate("\n" * 10)

    assert said.startswith("5 the libraries in")
    assert "cannot be written, and stay as they were" in said
    assert "free disk space" in said
    assert unharmed(shelf)
    shelf.editor.import_paints("Shop", read_csv(large), "update")
    assert len(shelf.table("Shop")) == PAINTS


def test_reader_sees_the_library_before_or_after_an_import(
    shelf: Shelf, large: Path
) -> None:
    with importing(shelf, large) as process:
        assert process.stdout
        assert process.stdout.readline()  # in the middle of it
        assert unharmed(shelf)
        process.communicate("\n" * 10)

    assert len(shelf.table("Shop")) == PAINTS


def test_second_writer_is_told_to_wait(
    shelf: Shelf, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("paintlink.library.database.BUSY_TIMEOUT_S", 0.0)
    with (
        writing(shelf.own.path),
        pytest.raises(LibraryStoreError, match="another import is at work"),
    ):
        shelf.editor.rename("Shop", "Other")

    assert shelf.editor.rename("Shop", "Other").name == "Other"


def test_damaged_file_is_refused_with_advice(tmp_path: Path) -> None:
    path = tmp_path / "library.db"
    path.write_bytes(b"SQLite format 3\x00" + bytes(5000))

    with pytest.raises(
        LibraryStoreError, match=r"library\.db cannot be read: .* backup"
    ):
        Shelf(path).own.present()


@pytest.mark.parametrize(
    ("sql", "says"),
    [
        ("UPDATE blocks SET lab = zeroblob(length(lab))", "the paints 1 to 10"),
        ("UPDATE blocks SET codes = replace(codes, 'P', 'Q')", "the paints 1 to 10"),
        ("UPDATE blocks SET finishes = 's'", "the paints 1 to 10"),
        ("DELETE FROM extras WHERE name = 'year'", "the paints 1 to 10"),
        ("UPDATE extras SET texts = replace(texts, '1', '2')", "the column"),
    ],
)
def test_paint_that_is_not_what_was_stored_is_never_shown(
    shelf: Shelf, sql: str, says: str
) -> None:
    with sqlite3.connect(shelf.own.path) as connection:
        connection.execute(sql)
    connection.close()

    with pytest.raises(
        LibraryStoreError, match=f"{says}.* not what was stored: restore it from a"
    ):
        shelf.table("Shop").facets["year"]


def test_file_of_a_newer_program_is_refused(shelf: Shelf) -> None:
    connection = sqlite3.connect(shelf.own.path)
    connection.execute("PRAGMA user_version=99")
    connection.close()

    for act in (shelf.entries, lambda: shelf.editor.remove("Shop")):
        with pytest.raises(LibraryStoreError, match="newer paintlink"):
            act()


def test_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    shelf = Shelf(tmp_path / "file" / "library.db")
    incoming = read_csv(write_csv(tmp_path / "p.csv", rows(3)))

    with pytest.raises(LibraryStoreError, match=r"file.library\.db cannot be written"):
        shelf.editor.import_paints("Shop", incoming)


def test_stored_numbers_are_the_numbers_of_the_file(shelf: Shelf) -> None:
    with sqlite3.connect(shelf.own.path) as connection:
        (blob,) = connection.execute("SELECT lab FROM blocks").fetchone()
        codes = connection.execute(
            "SELECT value FROM blocks, json_each(blocks.codes)"
        ).fetchall()
    connection.close()

    lab = np.frombuffer(blob, "<f8").reshape(3, 3, 10)
    assert lab[:, :, 4].ravel().tolist() == [float(c) for c in rows(10)[4][3:12]]
    assert [code for (code,) in codes] == [row[0] for row in rows(10)]
