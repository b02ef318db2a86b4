"""Opening library.db: durable, migrated, one writer at a time."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

from paintlink.errors import LibraryStoreError
from paintlink.library.schema import MIGRATIONS

BUSY_TIMEOUT_S = 10.0
CACHE_KIB = 64 * 1024


@contextmanager
def reading(path: Path) -> Iterator[sqlite3.Connection]:
    """The stored libraries as they are at this moment, whoever writes meanwhile.

    Raises
    ------
    LibraryStoreError
        When the file is not there, is damaged, or is newer than this program.
    """
    with _opened(path) as connection, _watched(path, "read"):
        _require_known(connection, path)
        connection.execute("BEGIN")
        yield connection


@contextmanager
def writing(path: Path, *, discard: bool = False) -> Iterator[sqlite3.Connection]:
    """The stored libraries inside one transaction: all of a change, or nothing.

    With ``discard``, nothing: the change is tried and taken back.

    Raises
    ------
    LibraryStoreError
        When it cannot be stored, such as on a full disk; nothing is changed then.
    """
    with _watched(path, "written"):
        path.parent.mkdir(parents=True, exist_ok=True)
    with _opened(path) as connection, _watched(path, "written"):
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("PRAGMA synchronous=FULL")
        connection.execute("PRAGMA foreign_keys=ON")
        connection.execute(f"PRAGMA cache_size=-{CACHE_KIB}")
        _migrate(connection, path)
        with _transaction(connection, "ROLLBACK" if discard else "COMMIT"):
            yield connection
        with suppress(sqlite3.Error):  # what was committed is safe without it
            connection.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()


@contextmanager
def _opened(path: Path) -> Iterator[sqlite3.Connection]:
    try:
        connection = sqlite3.connect(path, timeout=BUSY_TIMEOUT_S, isolation_level=None)
    except sqlite3.Error as error:
        msg = f"cannot open the libraries in {path}: {error}; check [state] folder"
        raise LibraryStoreError(msg) from error
    connection.row_factory = sqlite3.Row
    with closing(connection):
        yield connection


@contextmanager
def _watched(path: Path, done: str) -> Iterator[None]:
    try:
        yield
    except sqlite3.OperationalError as error:
        busy = error.sqlite_errorcode == sqlite3.SQLITE_BUSY
        advice = (
            "another import is at work, try again when it is done"
            if busy
            else "free disk space, or check the folder and its permissions"
        )
        msg = f"the libraries in {path} cannot be {done}, and stay as they were: "
        raise LibraryStoreError(f"{msg}{error}; {advice}") from error
    except (sqlite3.Error, OSError) as error:
        msg = f"the libraries in {path} cannot be {done}: {error}; restore a backup"
        raise LibraryStoreError(msg) from error


@contextmanager
def _transaction(connection: sqlite3.Connection, end: str = "COMMIT") -> Iterator[None]:
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
        connection.execute(end)
    except BaseException:
        with suppress(sqlite3.Error):
            if connection.in_transaction:
                connection.execute("ROLLBACK")
        raise


def _migrate(connection: sqlite3.Connection, path: Path) -> None:
    if _require_known(connection, path) == len(MIGRATIONS):
        return
    with _transaction(connection):
        version = _require_known(connection, path)
        for number, statements in enumerate(MIGRATIONS[version:], start=version + 1):
            for statement in statements:
                connection.execute(statement)
            connection.execute(f"PRAGMA user_version={number}")


def _require_known(connection: sqlite3.Connection, path: Path) -> int:
    version: int = connection.execute("PRAGMA user_version").fetchone()[0]
    if version > len(MIGRATIONS):
        msg = (
            f"the libraries in {path} were written by a newer paintlink (version "
            f"{version}, this one knows {len(MIGRATIONS)}): update paintlink"
        )
        raise LibraryStoreError(msg)
    return version
