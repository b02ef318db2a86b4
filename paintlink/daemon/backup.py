"""Copies of the journal: taken while the service runs, checked, and put back."""

from __future__ import annotations

import fcntl
import os
import shutil
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from datetime import datetime
from pathlib import Path

from paintlink.daemon.database import utc_now
from paintlink.daemon.journal import Journal
from paintlink.daemon.opening import (
    PARTS,
    explained,
    lock_path,
    suspect_path,
    whole,
)
from paintlink.daemon.schema import newest_version
from paintlink.errors import ConfigError, JournalError


def back_up(journal: Journal, target: Path) -> None:
    """Return when a whole, checked copy of the journal lies durably at ``target``.

    Raises
    ------
    JournalError
        When the copy cannot be written or does not pass its check.
    """
    if target.exists():
        msg = f"{target} exists: name a new file, so that no backup is lost"
        raise JournalError(msg)
    partial = target.with_name(f".{target.name}.part")
    with explained(f"cannot write {target}", "choose a folder you may write to"):
        partial.unlink(missing_ok=True)
        with closing(sqlite3.connect(partial)) as connection:
            journal.keeping.copy_to(connection)
            connection.execute("PRAGMA journal_mode=DELETE")
        check(partial)
        _sync(partial)
        partial.replace(target)
        _sync(target.parent)


def check(backup: Path) -> None:
    """Refuse a file that is no whole journal of this or an older program.

    Raises
    ------
    JournalError
        Saying what is wrong with it.
    """
    with (
        explained(f"{backup} cannot be used", "take another backup"),
        closing(sqlite3.connect(f"file:{backup}?mode=ro", uri=True)) as connection,
    ):
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        problem = whole(connection, backup)
    if problem is not None:
        msg = f"{backup} is damaged ({problem}): take another backup"
        raise JournalError(msg)
    if not 0 < version <= newest_version():
        known = f"this program reads 1 to {newest_version()}"
        msg = f"{backup} is no journal of this program (version {version}; {known})"
        raise JournalError(msg)


def restore(
    backup: Path, path: Path, *, now: Callable[[], datetime] = utc_now
) -> Path | None:
    """Folder of the journal that was replaced; None when there was none.

    What had not been settled when the backup was taken may have been delivered since:
    it becomes ``unknown`` and a person decides, so that nothing goes out twice.

    Raises
    ------
    ConfigError
        While somebody has the journal open.
    JournalError
        When the backup does not pass its check.
    """
    check(backup)
    with _alone(path), explained(f"cannot restore {path}", "check [state] folder"):
        aside = _set_aside(path, now())
        partial = path.with_name(f".{path.name}.part")
        shutil.copyfile(backup, partial)
        _sync(partial)
        partial.replace(path)
        suspect_path(path).unlink(missing_ok=True)
        _sync(path.parent)
    with Journal(path, now=now) as journal:
        journal.keeping.forget_unsettled(f"restored from {backup.name}")
    return aside


def _set_aside(path: Path, moment: datetime) -> Path | None:
    found = [path.with_name(path.name + end) for end in PARTS]
    found = [file for file in found if file.exists()]
    if not found:
        return None
    folder = path.parent / "replaced" / f"{moment:%Y%m%dT%H%M%S.%f}"
    folder.mkdir(parents=True)
    # The log first: a journal without its log is older, a log alone is nothing.
    for file in reversed(found):
        file.rename(folder / file.name)
    return folder


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    path.parent.mkdir(parents=True, exist_ok=True)
    lock = os.open(lock_path(path), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError as error:
        msg = f"the journal {path} is in use: stop paintlink first, then restore"
        raise ConfigError(msg) from error
    finally:
        os.close(lock)


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
