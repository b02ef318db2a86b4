"""A folder that other programs drop files into.

What decides is the scan: a file is taken once it has stayed the same for a quiet time,
by renaming it out of the inbox, and every file ends in exactly one place with the
reason beside it. Events of the file system are only hints to scan sooner.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from paintlink.errors import InputError

Outcome = Literal["done", "failed", "duplicate"]

REASON_SUFFIX = ".reason.txt"


@dataclass(frozen=True, slots=True)
class InboxFolders:
    """The folders a file passes through, all below one site folder."""

    inbox: Path
    working: Path
    done: Path
    failed: Path
    duplicate: Path

    @classmethod
    def below(cls, site: Path, inbox: Path | None = None) -> InboxFolders:
        """Return the usual names below a site folder."""
        names = ("working", "done", "failed", "duplicate")
        return cls(inbox or site / "inbox", *(site / name for name in names))

    def create(self) -> None:
        """Make the folders that are missing."""
        for name in self.__slots__:
            getattr(self, name).mkdir(parents=True, exist_ok=True)


class Claim(NamedTuple):
    """A file that is ours now; ``left_over`` when an interrupted run had taken it."""

    path: Path
    left_over: bool


class _Seen(NamedTuple):
    size: int
    mtime_ns: int
    inode: int
    since_s: float


class Inbox:
    """Files waiting in a folder, and where they go.

    Parameters
    ----------
    quiet_s
        How long a file must have stayed the same before it is taken.
    max_bytes
        Larger files are refused unread.
    clock
        Monotonic seconds.
    """

    def __init__(
        self,
        folders: InboxFolders,
        *,
        quiet_s: float,
        max_bytes: int,
        clock: Callable[[], float],
    ) -> None:
        self.folders = folders
        self._quiet_s = quiet_s
        self._max_bytes = max_bytes
        self._clock = clock
        self._seen: dict[str, _Seen] = {}

    def claim(self) -> Claim | None:
        """The next file that is ready, moved into ``working``.

        A file an interrupted run had already claimed comes first.
        """
        left = self._names(self.folders.working)
        if left:
            return Claim(self.folders.working / left[0], left_over=True)
        for name in self._ready():
            target = _free_name(self.folders.working, name)
            try:
                (self.folders.inbox / name).rename(target)
            except FileNotFoundError:
                continue
            return Claim(target, left_over=False)
        return None

    def read(self, claimed: Path) -> bytes:
        """Content of a claimed file.

        Raises
        ------
        InputError
            When it is not a regular file, empty, or too large.
        """
        try:
            descriptor = os.open(claimed, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        except OSError as error:
            msg = f"{claimed.name}: cannot be opened ({error.strerror})"
            raise InputError(msg) from error
        with os.fdopen(descriptor, "rb") as file:
            status = os.fstat(descriptor)
            if not stat.S_ISREG(status.st_mode):
                msg = f"{claimed.name}: not a regular file; drop files only"
                raise InputError(msg)
            if status.st_size > self._max_bytes:
                msg = (
                    f"{claimed.name}: {status.st_size} bytes, more than the "
                    f"{self._max_bytes} an inbox file may have"
                )
                raise InputError(msg)
            data = file.read()
        if not data:
            msg = f"{claimed.name}: the file is empty; export it again"
            raise InputError(msg)
        return data

    def finish(self, claimed: Path, outcome: Outcome, reason: str = "") -> Path:
        """Place of a claimed file once its fate is known.

        A reason is written beside it before it moves, so that no failed file is ever
        without one.
        """
        folder: Path = getattr(self.folders, outcome)
        target = _free_name(folder, claimed.name)
        if reason:
            note = target.with_name(target.name + REASON_SUFFIX)
            note.write_text(reason + "\n", encoding="utf-8")
        claimed.rename(target)
        return target

    def _ready(self) -> list[str]:
        now = self._clock()
        seen: dict[str, _Seen] = {}
        for entry in self._entries(self.folders.inbox):
            try:
                status = entry.stat(follow_symlinks=False)
            except FileNotFoundError:
                continue
            mark = (status.st_size, status.st_mtime_ns, status.st_ino)
            before = self._seen.get(entry.name)
            same = before is not None and before[:3] == mark
            seen[entry.name] = before if before and same else _Seen(*mark, now)
        self._seen = seen
        quiet = [(one.mtime_ns, name) for name, one in seen.items() if self._quiet(one)]
        return [name for _, name in sorted(quiet)]

    def _quiet(self, seen: _Seen) -> bool:
        return self._clock() - seen.since_s >= self._quiet_s

    def _names(self, folder: Path) -> list[str]:
        return sorted(entry.name for entry in self._entries(folder))

    def _entries(self, folder: Path) -> list[os.DirEntry[str]]:
        try:
            with os.scandir(folder) as entries:
                return [
                    entry
                    for entry in entries
                    if not entry.name.startswith(".")
                    and not entry.is_dir(follow_symlinks=False)
                ]
        except OSError as error:
            msg = f"{folder}: {error.strerror}; create the folder or correct [site]"
            raise InputError(msg) from error


def _free_name(folder: Path, name: str) -> Path:
    """A path in the folder that is not taken: ``x.xml``, ``x-2.xml``, ..."""
    target = folder / name
    stem, suffix = Path(name).stem, Path(name).suffix
    number = 2
    while os.path.lexists(target):
        target = folder / f"{stem}-{number}{suffix}"
        number += 1
    return target
