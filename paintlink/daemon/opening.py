"""Opening the journal's file: on a local disk, whole, and brought up to date."""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple, NoReturn

from paintlink.daemon import wal
from paintlink.daemon.schema import migrate, newest_version
from paintlink.errors import ConfigError, JournalError, JournalFullError
from paintlink.intake import mount_of

BUSY_TIMEOUT_S = 5.0
LOG_LIMIT_BYTES = 48 << 20
DAMAGED = {sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB}
PARTS = ("", "-wal")


class Opened(NamedTuple):
    """A connection, and the lock that tells others that the journal is in use."""

    connection: sqlite3.Connection
    lock: int


def open_database(path: Path) -> Opened:
    """The journal's file in WAL mode with ``synchronous=FULL``, migrated.

    The first to open it after an unclean stop checks it as a whole.

    Raises
    ------
    ConfigError
        When it lies on another machine.
    JournalError
        When the file cannot be opened, is damaged, is no journal, or is newer than this
        program.
    """
    require_local(path)
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
    with explained(f"cannot open the journal {path}", "check [state] folder"):
        lock = os.open(lock_path(path), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        alone = _lock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        connection = _connect(path, alone=alone)
        _lock(lock, fcntl.LOCK_SH)
    except BaseException:
        os.close(lock)
        raise
    return Opened(connection, lock)


def lock_path(journal: Path) -> Path:
    """The file whose lock everybody holds who has the journal open."""
    return journal.with_suffix(".lock")


def suspect_path(journal: Path) -> Path:
    """The file that asks the next start to check the journal."""
    return journal.with_suffix(".suspect")


def require_local(path: Path) -> None:
    """Refuse a journal that a power cut or another machine would tear.

    Raises
    ------
    ConfigError
        When its folder lies on a network file system.
    """
    mount = mount_of(path.parent)
    if mount.is_network:
        msg = (
            f"[state] folder {path.parent} lies on {mount.point}, a network share "
            f"({mount.type}): the journal would not survive there; choose a folder on "
            "a disk of this computer"
        )
        raise ConfigError(msg)


@contextmanager
def explained(what: str, advice: str) -> Iterator[None]:
    """Turns what SQLite or the disk refuses into a `JournalError`."""
    try:
        yield
    except (OSError, sqlite3.Error) as error:
        raise journal_error(error, what, advice) from error


def journal_error(error: Exception, what: str, advice: str) -> JournalError:
    """What SQLite or the disk refused, in words; a full disk is a class of its own."""
    if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
        return JournalFullError(f"{what}: {error}; free some disk space")
    return JournalError(f"{what}: {error}; {advice}")


def whole(connection: sqlite3.Connection, path: Path) -> str | None:
    """What is wrong with an opened journal file; None when nothing is."""
    try:
        problems = [row[0] for row in connection.execute("PRAGMA integrity_check(3)")]
    except sqlite3.DatabaseError as error:
        return str(error)
    if problems != ["ok"]:
        return "; ".join(str(problem).replace("\n", " ") for problem in problems)
    return wal.damage(path)


def _connect(path: Path, *, alone: bool) -> sqlite3.Connection:
    with explained(f"cannot open the journal {path}", "check [state] folder"):
        connection = sqlite3.connect(
            path, timeout=BUSY_TIMEOUT_S, isolation_level=None, check_same_thread=False
        )
    try:
        if alone and _needs_check(path):
            _require_whole(connection, path)
        with explained(f"the journal {path} cannot be used", "check the disk"):
            _prepare(connection, path)
            _sync_folder(path.parent)
    except BaseException as error:
        connection.close()
        if alone and getattr(error.__cause__, "sqlite_errorcode", None) in DAMAGED:
            _refuse(path, str(error.__cause__))
        raise
    return connection


def _sync_folder(folder: Path) -> None:
    """SQLite syncs the entry of its new log too, but passes over an error in that."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _prepare(connection: sqlite3.Connection, path: Path) -> None:
    connection.row_factory = sqlite3.Row
    for pragma in (
        "journal_mode=WAL",
        "synchronous=FULL",
        f"journal_size_limit={LOG_LIMIT_BYTES}",
    ):
        connection.execute(f"PRAGMA {pragma}")
    _bring_up_to_date(connection, path)
    connection.execute("PRAGMA foreign_keys=ON")


def _bring_up_to_date(connection: sqlite3.Connection, path: Path) -> None:
    connection.execute("BEGIN IMMEDIATE")
    try:
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        if version > newest_version():
            msg = (
                f"the journal {path} was written by a newer paintlink (version "
                f"{version}, this one knows {newest_version()}): update paintlink"
            )
            raise JournalError(msg)
        migrate(connection, version)
        connection.execute("COMMIT")
    except BaseException:
        if connection.in_transaction:
            connection.execute("ROLLBACK")
        raise


def _needs_check(path: Path) -> bool:
    """Whether the last to use it did not close it, or found it damaged."""
    log = path.with_name(path.name + "-wal")
    with suppress(OSError):
        return suspect_path(path).exists() or log.stat().st_size > 0
    return False


def _require_whole(connection: sqlite3.Connection, path: Path) -> None:
    problem = whole(connection, path)
    if problem is not None:
        # While the connection is open, SQLite has not yet written the log back.
        _refuse(path, problem)
    suspect_path(path).unlink(missing_ok=True)


def _refuse(path: Path, problem: str) -> NoReturn:
    """Keep a copy of a damaged journal aside; never start afresh."""
    with explained(f"no copy of the damaged journal {path} can be kept", "check it"):
        copy = _quarantine(path)
    msg = (
        f"the journal {path} is damaged ({problem}); a copy is kept in {copy}. Check "
        "the disk, then restore a backup with `paintlink restore FILE`; nothing was "
        "reset"
    )
    raise JournalError(msg)


def _quarantine(path: Path) -> Path:
    """Folder of the copy; the same damage is copied once, however often we start."""
    files = [path.with_name(path.name + end) for end in PARTS]
    found = [file for file in files if file.exists()]
    digest = hashlib.sha256(b"".join(file.read_bytes() for file in found)).hexdigest()
    folder = path.parent / "damaged" / digest[:12]
    if not folder.exists():
        folder.mkdir(parents=True)
        for file in found:
            shutil.copy2(file, folder / file.name)
    suspect_path(path).touch()
    return folder


def _lock(descriptor: int, operation: int) -> bool:
    try:
        fcntl.flock(descriptor, operation)
    except BlockingIOError:
        return False
    return True
