"""Opening the journal's SQLite file: durable, migrated, one writer at a time."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from paintlink.daemon.schema import MIGRATIONS
from paintlink.errors import JournalError

BUSY_TIMEOUT_S = 5.0


def utc_now() -> datetime:
    """The present, as an aware UTC time."""
    return datetime.now(UTC)


class Database:
    """The journal's SQLite file: WAL, ``synchronous=FULL``, migrated on opening.

    A transaction that returned has been synced to disk. Each thread opens its own.

    Raises
    ------
    JournalError
        When the file cannot be opened, is no journal, or is newer than this program.
    """

    def __init__(self, path: Path, now: Callable[[], datetime] = utc_now) -> None:
        self._now = now
        self._connection = _open(path)

    def close(self) -> None:
        """Close the file; the journal stays whole without it."""
        self._connection.close()

    @contextmanager
    def transaction(self) -> Iterator[None]:
        """One durable transaction: committed on leaving, rolled back on any error."""
        with _transaction(self._connection):
            yield

    def one(self, sql: str, *values: Any) -> sqlite3.Row | None:
        """The first row of a query."""
        row: sqlite3.Row | None = self._connection.execute(sql, values).fetchone()
        return row

    def all(self, sql: str, *values: Any) -> list[sqlite3.Row]:
        """All rows of a query."""
        return self._connection.execute(sql, values).fetchall()

    def run(self, sql: str, *values: Any) -> None:
        """Execute a statement inside the open transaction."""
        self._connection.execute(sql, values)

    def insert(self, table: str, **columns: Any) -> int:
        """Id of a new row."""
        names = ", ".join(columns)
        marks = ", ".join("?" * len(columns))
        cursor = self._connection.execute(
            f"INSERT INTO {table} ({names}) VALUES ({marks})", tuple(columns.values())
        )
        return int(cursor.lastrowid or 0)

    def update(self, table: str, row_id: int, **columns: Any) -> None:
        """Change columns of one row."""
        names = ", ".join(f"{name} = ?" for name in columns)
        self.run(f"UPDATE {table} SET {names} WHERE id = ?", *columns.values(), row_id)

    def log(self, job_id: int, kind: str, text: str) -> None:
        """Add to the history of a job."""
        self.insert("events", at=self.stamp(), job_id=job_id, kind=kind, text=text)

    def stamp(self) -> str:
        """The present as the journal writes it."""
        return self._now().isoformat()


def _open(path: Path) -> sqlite3.Connection:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        connection = sqlite3.connect(
            path, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False
        )
    except (OSError, sqlite3.Error) as error:
        msg = f"cannot open the journal {path}: {error}; check [state] folder"
        raise JournalError(msg) from error
    try:
        connection.row_factory = sqlite3.Row
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("PRAGMA synchronous=FULL")
        connection.execute("PRAGMA foreign_keys=ON")
        _migrate(connection, path)
    except (sqlite3.Error, JournalError) as error:
        connection.close()
        if isinstance(error, JournalError):
            raise
        msg = f"the journal {path} cannot be used: {error}; restore it from a backup"
        raise JournalError(msg) from error
    return connection


@contextmanager
def _transaction(connection: sqlite3.Connection) -> Iterator[None]:
    try:
        connection.execute("BEGIN IMMEDIATE")
        yield
        connection.execute("COMMIT")
    except sqlite3.Error as error:
        _roll_back(connection)
        msg = (
            f"the journal refused to store: {error}; free disk space or check the disk"
        )
        raise JournalError(msg) from error
    except BaseException:
        _roll_back(connection)
        raise


def _roll_back(connection: sqlite3.Connection) -> None:
    if connection.in_transaction:
        connection.execute("ROLLBACK")


def _migrate(connection: sqlite3.Connection, path: Path) -> None:
    with _transaction(connection):
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        if version > len(MIGRATIONS):
            msg = (
                f"the journal {path} was written by a newer paintlink (version "
                f"{version}, this one knows {len(MIGRATIONS)}): update paintlink"
            )
            raise JournalError(msg)
        for number, script in enumerate(MIGRATIONS[version:], start=version + 1):
            for statement in script.split(";"):
                if statement.strip():
                    connection.execute(statement)
            connection.execute(f"PRAGMA user_version={number}")
