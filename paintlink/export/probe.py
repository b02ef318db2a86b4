"""Whether a delivery into a folder would work, found out before the first one."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from paintlink.errors import ExportError
from paintlink.export.delivery import STAGING
from paintlink.export.folders import NEW_FILE_FLAGS, exists, explained, opened
from paintlink.export.rename import rename_noreplace

LEAST_FREE_BYTES = 1 << 20


def probe(folder: Path) -> str | None:
    """What would stop a delivery into the folder and what to do; None when nothing.

    Publishes nothing and leaves nothing behind. A missing staging folder stays missing:
    its absence is what `outcome` goes by.
    """
    try:
        with explained(folder), opened(folder) as folder_fd:
            _try_move(folder_fd, folder_fd)
            _require_space(folder, folder_fd)
            staging_is_there = exists(STAGING, folder_fd)
        if staging_is_there:
            _try_staging(folder)
    except ExportError as error:
        return str(error)
    return None


def _try_staging(folder: Path) -> None:
    with (
        explained(folder / STAGING),
        opened(folder) as folder_fd,
        opened(STAGING, within_fd=folder_fd) as staging_fd,
    ):
        _try_move(staging_fd, folder_fd)


def _try_move(source_fd: int, target_fd: int) -> None:
    """Create, move and remove a hidden file, durably."""
    name = f".paintlink-probe-{os.getpid()}"
    moved = f"{name}-moved"
    try:
        _create(name, source_fd)
        rename_noreplace(name, source_fd, moved, target_fd)
        os.fsync(target_fd)
    finally:
        with suppress(OSError):
            os.unlink(moved, dir_fd=target_fd)
        with suppress(OSError):
            os.unlink(name, dir_fd=source_fd)


def _create(name: str, folder_fd: int) -> None:
    fd = os.open(name, NEW_FILE_FLAGS, 0o600, dir_fd=folder_fd)
    try:
        os.write(fd, b"paintlink looks whether it can deliver here\n")
        os.fsync(fd)
    finally:
        os.close(fd)


def _require_space(folder: Path, folder_fd: int) -> None:
    state = os.fstatvfs(folder_fd)
    free = state.f_bavail * state.f_frsize
    if free < LEAST_FREE_BYTES:
        msg = f"{folder}: only {free // 1024} KiB are free; free at least 1 MiB"
        raise ExportError(msg, kind="full")
