"""One user for an instrument at a time: the service lends it to a command.

Two lock files for each instrument. Who uses the instrument holds the one; a command
that waits for it holds the other, and the service lets go when it sees that. The kernel
gives locks back when a process ends, however it ends.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from paintlink.errors import LinkError

FOLDER = "instruments"
PATIENCE_S = 10.0
LOOK_EVERY_S = 0.05


class Loan:
    """The service's side: it holds the instrument until somebody asks for it."""

    def __init__(self, state_folder: Path, name: str) -> None:
        self._use, self._queue = _open(state_folder, name)
        self.held = False

    def wanted(self) -> bool:
        """Whether a command waits for the instrument."""
        if not _locked(self._queue):
            return True
        fcntl.flock(self._queue, fcntl.LOCK_UN)
        return False

    def hold(self) -> bool:
        """Take the instrument; False while somebody else uses it or waits for it."""
        self.held = self.held or (not self.wanted() and _locked(self._use))
        return self.held

    def release(self) -> None:
        """Let the next one have the instrument."""
        if self.held:
            fcntl.flock(self._use, fcntl.LOCK_UN)
            self.held = False

    def close(self) -> None:
        """Let go for good."""
        os.close(self._use)
        os.close(self._queue)


@contextmanager
def borrowed(state_folder: Path, name: str) -> Iterator[None]:
    """Hold an instrument for one command; the service waits meanwhile.

    Raises
    ------
    LinkError
        When the one who uses it does not let go within 10 s.
    """
    use, queue = _open(state_folder, name)
    try:
        _wait(queue, name)
        _wait(use, name)
        fcntl.flock(queue, fcntl.LOCK_UN)
        yield
    finally:
        os.close(use)
        os.close(queue)


def _wait(descriptor: int, name: str) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not _locked(descriptor):
        if time.monotonic() >= deadline:
            msg = (
                f"{name} is in use by another paintlink command or in the middle of a "
                "reading: wait for its end and try again"
            )
            raise LinkError(msg)
        time.sleep(LOOK_EVERY_S)


def _locked(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _open(state_folder: Path, name: str) -> tuple[int, int]:
    folder = state_folder / FOLDER
    # A name may hold what no file name may, and two names may differ in that alone.
    stem = hashlib.sha256(name.encode()).hexdigest()[:16]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return _lock_file(folder / f"{stem}.use"), _lock_file(folder / f"{stem}.queue")
    except OSError as error:
        msg = (
            f"{name} cannot be had: {error.strerror} at {error.filename}: run the "
            "command as the user of the service, or check [state] folder"
        )
        raise LinkError(msg) from error


def _lock_file(path: Path) -> int:
    return os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o660)
