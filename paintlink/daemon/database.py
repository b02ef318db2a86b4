"""The journal's SQLite file at work: one durable transaction after another."""

from __future__ import annotations

import os
import sqlite3
import threading
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from paintlink.daemon import audit
from paintlink.daemon.opening import (
    DAMAGED,
    LOG_LIMIT_BYTES,
    journal_error,
    open_database,
    suspect_path,
)
from paintlink.errors import JournalError

REFUSED = "the journal refused to store"
ADVICE = "free disk space or check the disk"

# The program's own mistakes: the disk and the journal are as good as before.
MISTAKES = (sqlite3.IntegrityError, sqlite3.ProgrammingError, sqlite3.DataError)

# Writers that meet in SQLite sleep up to 0.1 s at a time; threads queue here instead.
_turns: defaultdict[str, threading.RLock] = defaultdict(threading.RLock)


def utc_now() -> datetime:
    """The present, as an aware UTC time."""
    return datetime.now(UTC)


class Database:
    """The journal's SQLite file: WAL, ``synchronous=FULL``, migrated on opening.

    A transaction that returned has been synced to disk. Each thread opens its own.

    Raises
    ------
    ConfigError
        When the file lies on a network share.
    JournalError
        When the file cannot be opened, is no journal, is damaged, or is newer than
        this program.
    """

    def __init__(self, path: Path, now: Callable[[], datetime] = utc_now) -> None:
        self._now = now
        self._path = path
        self._log_path = path.with_name(path.name + "-wal")
        self._turn = _turns[str(path)]
        self._connection, self._lock = open_database(path)

    def close(self) -> None:
        """Close the file; the journal stays whole without it."""
        self._connection.close()
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1

    @contextmanager
    def transaction(self, *, durable: bool = True) -> Iterator[None]:
        """One durable transaction: committed on leaving, rolled back on any error.

        One inside another is part of it: nothing is durable before the outer one is.

        Parameters
        ----------
        durable
            False: seen by everybody at once, synced with the next durable one.
        """
        if self._connection.in_transaction:
            yield
            return
        if not durable:
            with self._without_sync(), self.transaction():
                yield
            return
        with self._turn, self._watched(REFUSED, ADVICE):
            self._bound_log()
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._connection.execute("COMMIT")
            except BaseException:
                self._roll_back()
                raise

    @contextmanager
    def _without_sync(self) -> Iterator[None]:
        self._connection.execute("PRAGMA synchronous=NORMAL")
        try:
            yield
        finally:
            self._connection.execute("PRAGMA synchronous=FULL")

    def one(self, sql: str, *values: Any) -> sqlite3.Row | None:
        """The first row of a query."""
        with self._watched("the journal cannot be read", ADVICE):
            row: sqlite3.Row | None = self._connection.execute(sql, values).fetchone()
        return row

    def all(self, sql: str, *values: Any) -> list[sqlite3.Row]:
        """All rows of a query."""
        with self._watched("the journal cannot be read", ADVICE):
            return self._connection.execute(sql, values).fetchall()

    def run(self, sql: str, *values: Any) -> int:
        """Number of rows that a statement inside the open transaction changed."""
        return self._connection.execute(sql, values).rowcount

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

    def log(self, job_id: int, kind: str, text: str, **facts: Any) -> None:
        """Add to the history of a job; the sinks tell it to others from here."""
        last = self.one("SELECT chain FROM events ORDER BY id DESC LIMIT 1")
        entry = audit.Entry(self.stamp(), job_id, kind, text, audit.facts_text(facts))
        chain = audit.link(last["chain"] if last else "", entry)
        self.insert("events", **entry._asdict(), chain=chain)

    def stamp(self) -> str:
        """The present as the journal writes it."""
        return self._now().isoformat()

    def changes(self) -> int:
        """A number that grows when somebody else has written."""
        row = self.one("PRAGMA data_version")
        return int(row[0]) if row else 0

    def copy_to(self, target: sqlite3.Connection) -> None:
        """Write a consistent copy of the whole journal, while others go on."""
        with self._watched("the journal cannot be copied", ADVICE):
            self._connection.backup(target)

    def _bound_log(self) -> None:
        """Keep the log below its limit, or refuse: a full disk would be worse."""
        with suppress(FileNotFoundError):
            if self._log_path.stat().st_size < LOG_LIMIT_BYTES:
                return
            busy = self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            if busy.fetchone()[0]:
                msg = (
                    f"{self._log_path} is full and another program keeps the journal "
                    "open: end that program"
                )
                raise JournalError(msg)

    @contextmanager
    def _watched(self, what: str, advice: str) -> Iterator[None]:
        try:
            yield
        except MISTAKES:
            raise
        except sqlite3.Error as error:
            if getattr(error, "sqlite_errorcode", None) in DAMAGED:
                suspect_path(self._path).touch()
            raise journal_error(error, what, advice) from error

    def _roll_back(self) -> None:
        with suppress(sqlite3.Error):
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")
