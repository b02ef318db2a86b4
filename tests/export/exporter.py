"""Six readings on their way through a journal into a folder; killed by the tests.

Usage: exporter.py PROTOCOL FOLDER JOURNAL. ``token`` is the product's protocol; the
others are the mistakes that the tests must notice; ``idle`` does nothing.
"""

from __future__ import annotations

import sqlite3
import sys
from pathlib import Path

from paintlink.export import outcome, publish, stage

READINGS = range(1, 7)


def content(reading: int) -> bytes:
    return f"reading {reading}\n".encode() * 2000


class Journal:
    def __init__(self, path: Path) -> None:
        self.db = sqlite3.connect(path, isolation_level=None)
        self.db.execute("PRAGMA journal_mode = WAL")
        self.db.execute("PRAGMA synchronous = FULL")
        self.db.execute(
            "CREATE TABLE IF NOT EXISTS deliveries (id INTEGER PRIMARY KEY, state TEXT)"
        )
        self.db.executemany(
            "INSERT OR IGNORE INTO deliveries VALUES (?, 'pending')",
            [(reading,) for reading in READINGS],
        )

    def waiting(self) -> list[tuple[int, str]]:
        sql = (
            "SELECT id, state FROM deliveries WHERE state <> 'written' "
            "ORDER BY state DESC, id"
        )
        return self.db.execute(sql).fetchall()

    def mark(self, reading: int, state: str) -> None:
        sql = "UPDATE deliveries SET state = ? WHERE id = ?"
        self.db.execute(sql, (state, reading))


def token(folder: Path, journal: Journal, reading: int, state: str) -> None:
    if state == "pending":
        stage(folder, f"token-{reading}", content(reading))
        journal.mark(reading, "publishing")
    found = outcome(folder, f"token-{reading}")
    if found == "unknown":
        sys.exit(3)
    if found == "staged":
        publish(folder, f"token-{reading}", f"{reading}.xml")
    journal.mark(reading, "written")


def mark_after(folder: Path, journal: Journal, reading: int, _state: str) -> None:
    stage(folder, f"token-{reading}", content(reading))
    (folder / ".paintlink" / f"token-{reading}").replace(folder / f"{reading}.xml")
    journal.mark(reading, "written")


def mark_before(folder: Path, journal: Journal, reading: int, _state: str) -> None:
    stage(folder, f"token-{reading}", content(reading))
    journal.mark(reading, "written")
    publish(folder, f"token-{reading}", f"{reading}.xml")


def in_place(folder: Path, journal: Journal, reading: int, _state: str) -> None:
    half = len(content(reading)) // 2
    with (folder / f"{reading}.xml").open("wb", buffering=0) as file:
        file.write(content(reading)[:half])
        file.write(content(reading)[half:])
    journal.mark(reading, "written")


PROTOCOLS = {
    "token": token,
    "mark-after": mark_after,
    "mark-before": mark_before,
    "in-place": in_place,
}


def export(protocol: str, folder: Path, journal_path: Path) -> None:
    """Deliver what is waiting, by a protocol."""
    journal = Journal(journal_path)
    for reading, state in journal.waiting():
        PROTOCOLS[protocol](folder, journal, reading, state)
    journal.db.close()


if __name__ == "__main__":
    named, folder_name, journal_name = sys.argv[1:]
    if named != "idle":
        export(named, Path(folder_name), Path(journal_name))
