"""Folders of other programs: opened once, worked in by descriptor, faults explained."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from paintlink.errors import ExportError, ExportFault

FOLDER_FLAGS = os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC
NEW_FILE_FLAGS = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC

GUARD = ".paintlink-share"

FAULTS: dict[int, tuple[ExportFault, str]] = {
    errno.ENOENT: (
        "missing",
        "the folder does not exist; create it, connect its share, or correct the "
        "folder of the route",
    ),
    errno.ENOTDIR: (
        "not-a-folder",
        "this is not a folder; remove it or correct the folder of the route",
    ),
    errno.EXDEV: (
        "not-a-folder",
        ".paintlink lies on another file system; make it a plain folder in here",
    ),
    errno.EACCES: (
        "denied",
        "paintlink may not write here; give its user read, write and search "
        "permission on the folder",
    ),
    errno.EROFS: (
        "read-only",
        "the file system is mounted read-only; mount it for writing",
    ),
    errno.ENOSPC: ("full", "the disk is full; free some space"),
    errno.ENAMETOOLONG: (
        "name",
        "the file system takes no name this long; shorten the file-name pattern of "
        "the format",
    ),
    errno.EEXIST: (
        "exists",
        "a file of this name lies there already and is never overwritten; take it "
        "away, or resend the job under a new name",
    ),
}
FAULTS[errno.EPERM] = FAULTS[errno.EACCES]
FAULTS[errno.EDQUOT] = FAULTS[errno.ENOSPC]
FAULTS[errno.ELOOP] = FAULTS[errno.ENOTDIR]
OTHER_FAULT = "{reason}; check the disk, or the network share and its server"


@contextmanager
def opened(folder: Path | str, *, within_fd: int | None = None) -> Iterator[int]:
    """A descriptor of a folder; one inside another may not be a symbolic link."""
    no_link = 0 if within_fd is None else os.O_NOFOLLOW
    fd = os.open(folder, FOLDER_FLAGS | no_link, dir_fd=within_fd)
    try:
        yield fd
    finally:
        os.close(fd)


def exists(name: str, folder_fd: int) -> bool:
    """Whether a folder holds an entry of this name, whatever it is."""
    try:
        os.stat(name, dir_fd=folder_fd, follow_symlinks=False)
    except FileNotFoundError:
        return False
    return True


@contextmanager
def explained(place: Path) -> Iterator[None]:
    """Turns what the system refuses into an `ExportError` that says what to do next."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or str(error)
        kind, advice = FAULTS.get(error.errno or 0, ("io", OTHER_FAULT))
        msg = f"{place}: {advice.format(reason=reason)}"
        raise ExportError(msg, kind=kind) from error


def require_share(folder: Path) -> None:
    """Refuse an empty mount point in the place of the share that belongs there.

    Raises
    ------
    ExportError
        When the file that marks the share cannot be seen.
    """
    with explained(folder), opened(folder) as folder_fd:
        marked = exists(GUARD, folder_fd)
    if not marked:
        msg = (
            f"{folder}: {GUARD} is not there, so the share is not connected; mount it, "
            "or create that file once on the share itself"
        )
        raise ExportError(msg, kind="missing")
