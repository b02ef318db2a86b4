"""A folder that other programs drop files into.

What decides is the scan: a file is taken once it has stayed the same for a quiet time,
by renaming it out of the inbox, and every file ends in exactly one place with the
reason beside it. Events of the file system are only hints to scan sooner.
"""

from __future__ import annotations

import errno
import os
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Literal, NamedTuple

from paintlink.errors import InputError
from paintlink.intake.folders import (
    InboxFolders,
    carry,
    free_name,
    left_behind,
    move,
    require_share,
)
from paintlink.intake.safe import BUSY, read_regular

Outcome = Literal["done", "failed", "duplicate"]

REASON_SUFFIX = ".reason.txt"
WATCHED_AT_ONCE = 1000  # a hundred thousand files cost no more memory than these
RETRY_S = 2.0


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
    share
        Whether the folder is a share, which a file of its own tells from the empty
        place where it is mounted.
    patience_s
        How long a claimed file that cannot be used may still change: some programs
        pause while they write.
    """

    def __init__(
        self,
        folders: InboxFolders,
        *,
        quiet_s: float,
        max_bytes: int,
        clock: Callable[[], float],
        share: bool = False,
        patience_s: float = 0.0,
    ) -> None:
        self.folders = folders
        self._quiet_s = quiet_s
        self._max_bytes = max_bytes
        self._clock = clock
        self._share = share
        self._patience_s = patience_s
        self._seen: dict[str, _Seen] = {}
        self._ready: deque[str] = deque()
        self._again_at: dict[str, float] = {}
        self._claimed_at: dict[str, float] = {}

    @property
    def unsettled(self) -> bool:
        """Whether something waits for its quiet time, or to be tried again."""
        return bool(self._seen or self._again_at)

    def claim(self) -> Claim | None:
        """The next file that is ready, moved into ``working``.

        A file an interrupted run had already claimed comes first.

        Raises
        ------
        InputError
            When the folder cannot be looked into now.
        """
        if self._share:
            require_share(self.folders.inbox)
        left = self._left_over()
        if left is not None:
            return Claim(left, left_over=left.name not in self._claimed_at)
        if not self._ready:
            self._look()
        while self._ready:
            name = self._ready.popleft()
            seen = self._seen.pop(name, None)
            if seen is not None and self._unchanged(name, seen):
                taken = self._take(name)
                if taken is not None:
                    self._claimed_at[taken.name] = self._clock()
                    return Claim(taken, left_over=False)
        return None

    def read(self, claimed: Path) -> bytes:
        """Content of a claimed file.

        Raises
        ------
        BusyFileError
            When another program keeps it closed to us for now: `postpone` it.
        InputError
            When it is no regular file of its own, empty, or too large.
        """
        return read_regular(claimed.name, claimed.parent, self._max_bytes)

    def postpone(self, claimed: Path, *, patience_s: float | None = None) -> bool:
        """Whether a claimed file is worth another look later; it stays claimed."""
        limit_s = self._patience_s if patience_s is None else patience_s
        since = self._claimed_at.setdefault(claimed.name, self._clock())
        if self._clock() - since >= limit_s:
            return False
        self._again_at[claimed.name] = self._clock() + min(RETRY_S, limit_s)
        return True

    def finish(self, claimed: Path, outcome: Outcome, reason: str = "") -> Path:
        """Place of a claimed file once its fate is known.

        A reason is written beside it before it moves, so that no failed file is ever
        without one.
        """
        folder: Path = getattr(self.folders, outcome)
        name = free_name(claimed.name, folder)
        if reason:
            note = folder / f"{name}{REASON_SUFFIX}"
            note.write_text(reason + "\n", encoding="utf-8")
        target = move(claimed.name, claimed.parent, folder, name)
        self._claimed_at.pop(claimed.name, None)
        self._again_at.pop(claimed.name, None)
        return target

    def _left_over(self) -> Path | None:
        """A claimed file to go on with; those that are to be tried later wait."""
        now = self._clock()
        for entry in self._entries(self.folders.working):
            if self._again_at.get(entry.name, now) <= now:
                self._again_at.pop(entry.name, None)
                return self.folders.working / entry.name
        with suppress(OSError):
            return left_behind(self.folders.inbox, self.folders.working)
        return None

    def _take(self, name: str) -> Path | None:
        source, target = self.folders.inbox, self.folders.working
        try:
            return move(name, source, target)
        except FileNotFoundError:
            return None
        except OSError as error:
            if error.errno == errno.EXDEV:
                return carry(name, source, target)
            if error.errno in BUSY | {errno.EPERM}:
                return None
            raise

    def _look(self) -> None:
        """Watch the first files of the folder, and list those that are quiet."""
        now = self._clock()
        seen: dict[str, _Seen] = {}
        for entry in self._entries(self.folders.inbox):
            with suppress(FileNotFoundError):
                mark = _mark(entry.stat(follow_symlinks=False))
                before = self._seen.get(entry.name)
                same = before is not None and before[:3] == mark
                seen[entry.name] = before if before and same else _Seen(*mark, now)
            if len(seen) >= WATCHED_AT_ONCE:
                break
        self._seen = seen
        quiet = [
            (one.mtime_ns, name)
            for name, one in seen.items()
            if now - one.since_s >= self._quiet_s
        ]
        self._ready = deque(name for _, name in sorted(quiet))

    def _unchanged(self, name: str, seen: _Seen) -> bool:
        with suppress(OSError):
            return _mark((self.folders.inbox / name).lstat()) == seen[:3]
        return False

    def _entries(self, folder: Path) -> Iterator[os.DirEntry[str]]:
        try:
            with os.scandir(folder) as entries:
                for entry in entries:
                    if not entry.name.startswith(".") and not entry.is_dir(
                        follow_symlinks=False
                    ):
                        yield entry
        except OSError as error:
            msg = f"{folder}: {error.strerror}; create the folder or correct [site]"
            raise InputError(msg) from error


def _mark(status: os.stat_result) -> tuple[int, int, int]:
    return status.st_size, status.st_mtime_ns, status.st_ino
