"""Opening files that strangers put into a folder, without following them anywhere."""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import stat
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from paintlink.errors import InputError

FOLDER_FLAGS = os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC
# A FIFO opens at once and is then refused; blocking would wait for its writer.
FILE_FLAGS = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY

OPENAT2 = 437  # the same number on every architecture that has it
RESOLVE_NO_MAGICLINKS = 0x02
RESOLVE_NO_SYMLINKS = 0x04
RESOLVE_BENEATH = 0x08
RESOLVE = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS
NOT_OFFERED = {errno.ENOSYS, errno.EPERM, errno.E2BIG}

BUSY = {errno.EBUSY, errno.ETXTBSY, errno.EAGAIN, errno.EACCES, errno.ESTALE, errno.EIO}

_libc = ctypes.CDLL(None, use_errno=True)


class BusyFileError(InputError):
    """Try again later: another program still has its hands on the file."""


@contextmanager
def opened_folder(folder: Path) -> Iterator[int]:
    """A descriptor of a folder; what happens to its path afterwards does not matter."""
    descriptor = os.open(folder, FOLDER_FLAGS)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def open_beneath(name: str, folder_fd: int) -> int:
    """Descriptor of an entry of a folder, never of anything a link leads to."""
    if "/" in name or name in {"", ".", ".."}:
        raise OSError(errno.EXDEV, "not the name of an entry", name)
    how = struct.pack("QQQ", FILE_FLAGS, 0, RESOLVE)
    if platform.system() == "Linux":
        found: int = _libc.syscall(OPENAT2, folder_fd, os.fsencode(name), how, len(how))
        if found >= 0:
            return found
        code = ctypes.get_errno()
        if code not in NOT_OFFERED:
            raise OSError(code, os.strerror(code), name)
    return os.open(name, FILE_FLAGS, dir_fd=folder_fd)


def read_regular(name: str, folder: Path, max_bytes: int) -> bytes:
    """Content of a regular file that belongs to this folder alone.

    Raises
    ------
    BusyFileError
        When another program keeps it closed to us for now.
    InputError
        When it is a link, a pipe, a device, empty, or too large.
    """
    try:
        with opened_folder(folder) as folder_fd:
            descriptor = open_beneath(name, folder_fd)
        with os.fdopen(descriptor, "rb") as file:
            _require_plain(os.fstat(descriptor), name, max_bytes)
            data = file.read(max_bytes + 1)
    except OSError as error:
        kind = BusyFileError if error.errno in BUSY else InputError
        msg = f"{name}: cannot be opened ({error.strerror})"
        raise kind(msg) from error
    if not data:
        msg = f"{name}: the file is empty; export it again"
        raise InputError(msg)
    _require_size(len(data), name, max_bytes)
    return data


def _require_plain(status: os.stat_result, name: str, max_bytes: int) -> None:
    if not stat.S_ISREG(status.st_mode):
        msg = f"{name}: not a regular file; drop files only"
        raise InputError(msg)
    if status.st_nlink != 1:
        msg = f"{name}: a hard link to a file elsewhere; drop a copy of it"
        raise InputError(msg)
    _require_size(status.st_size, name, max_bytes)


def _require_size(size: int, name: str, max_bytes: int) -> None:
    if size > max_bytes:
        msg = f"{name}: {size} bytes, more than the {max_bytes} a file here may have"
        raise InputError(msg)
