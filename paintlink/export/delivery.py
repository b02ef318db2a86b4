"""Exactly-once delivery into a folder that another program watches and empties.

The staged file is the token: as long as it exists, nothing has been published; once it
is gone, everything has. The journal goes from pending to publishing between `stage` and
`publish`, and to written after `publish`. After a crash or an error in publishing, ask
`outcome` and do nothing else: a file that is gone may have been taken already.

Settle every publishing delivery of a folder before staging another one there: `stage`
creates a staging folder that is missing, and would hide that tokens were lost with it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Literal

from paintlink.errors import ExportError
from paintlink.export.folders import NEW_FILE_FLAGS, exists, explained, opened
from paintlink.export.rename import rename_noreplace

STAGING = ".paintlink"

Outcome = Literal["staged", "published", "unknown"]


def stage(folder: Path, token: str, data: bytes, *, mode: int | None = None) -> None:
    """Return when the data lie durably in the staging folder, under ``token``.

    What an interrupted staging left under the same token is replaced.

    Parameters
    ----------
    token
        Unique to this delivery among all programs that stage in this folder.
    mode
        Permission bits of the file; None leaves them to the umask.

    Raises
    ------
    ExportError
        Nothing was published; the delivery stays pending and can be staged again.
    """
    stage_many(folder, {token: data}, mode=mode)


def stage_many(
    folder: Path,
    files: Mapping[str, bytes],
    *,
    mode: int | None = None,
    threads: int = 1,
) -> None:
    """Return when all files, by token, lie durably in the staging folder.

    Parameters
    ----------
    threads
        How many files to sync at once: a disk does that together, at the price of one.

    Raises
    ------
    ExportError
        Nothing was published; the deliveries stay pending and can be staged again.
    """
    for token in files:
        _require_entry_name(token)
    with explained(folder), opened(folder) as folder_fd:
        with suppress(FileExistsError):
            os.mkdir(STAGING, 0o700, dir_fd=folder_fd)
        os.fsync(folder_fd)
        with _staging(folder, folder_fd) as staging_fd:

            def write(token: str) -> None:
                _remove(token, staging_fd)
                _write_new(token, staging_fd, files[token], mode)

            if threads > 1 and len(files) > 1:
                with ThreadPoolExecutor(threads) as pool:
                    list(pool.map(write, files))
            else:
                for token in files:
                    write(token)
            os.fsync(staging_fd)


def publish(folder: Path, token: str, name: str) -> Path:
    """Path of the staged file under its final name, whole and durable.

    Raises
    ------
    ExportError
        The file may or may not have been published: `outcome` tells. Kind ``exists``
        when the name is taken.
    """
    _require_entry_name(token)
    _require_entry_name(name)
    with (
        explained(folder),
        opened(folder) as folder_fd,
        _staging(folder, folder_fd) as staging_fd,
    ):
        if not exists(token, staging_fd):
            msg = (
                f"{folder / STAGING / token}: the staged file is gone; it was "
                "published before, or somebody removed it"
            )
            raise ExportError(msg, kind="gone")
        with explained(folder / name):
            rename_noreplace(token, staging_fd, name, folder_fd)
        os.fsync(folder_fd)
        os.fsync(staging_fd)
    return folder / name


def publish_many(folder: Path, names: Mapping[str, str]) -> dict[str, ExportError]:
    """What could not be published of staged files, by token; the rest is, durably.

    Parameters
    ----------
    names
        The final name of each token.

    Raises
    ------
    ExportError
        Any of the files may or may not have been published: `outcome` tells.
    """
    refused: dict[str, ExportError] = {}
    for token, name in names.items():
        _require_entry_name(token)
        _require_entry_name(name)
    with (
        explained(folder),
        opened(folder) as folder_fd,
        _staging(folder, folder_fd) as staging_fd,
    ):
        for token, name in names.items():
            try:
                with explained(folder / name):
                    rename_noreplace(token, staging_fd, name, folder_fd)
            except ExportError as error:
                refused[token] = error
        os.fsync(folder_fd)
        os.fsync(staging_fd)
    return refused


def outcome(folder: Path, token: str) -> Outcome:
    """What became of a delivery that was being published.

    ``staged``: not published, `publish` it now. ``published``: durably so, and perhaps
    taken already. ``unknown``: the staging folder is gone and the token with it; a
    person has to look.

    Raises
    ------
    ExportError
        When the folder cannot be looked at now; ask again later.
    """
    _require_entry_name(token)
    with explained(folder), opened(folder) as folder_fd:
        if not exists(STAGING, folder_fd):
            return "unknown"
        with _staging(folder, folder_fd) as staging_fd:
            if exists(token, staging_fd):
                return "staged"
            # The rename may have happened without its fsync: a power cut would undo
            # it after the journal has said "written".
            os.fsync(folder_fd)
            os.fsync(staging_fd)
    return "published"


def discard(folder: Path, token: str) -> None:
    """Remove the staged file of a delivery that has been given up."""
    _require_entry_name(token)
    with explained(folder), opened(folder) as folder_fd:
        if not exists(STAGING, folder_fd):
            return
        with _staging(folder, folder_fd) as staging_fd:
            _remove(token, staging_fd)
            os.fsync(staging_fd)


@contextmanager
def _staging(folder: Path, folder_fd: int) -> Iterator[int]:
    with ExitStack() as stack:
        with explained(folder / STAGING):
            if not exists(STAGING, folder_fd):
                msg = (
                    f"{folder / STAGING}: the staging folder is gone, and with it the "
                    "proof of what was published; look in the folder, then resend"
                )
                raise ExportError(msg, kind="gone")
            fd = stack.enter_context(opened(STAGING, within_fd=folder_fd))
        yield fd


def _require_entry_name(name: str) -> None:
    if name in {"", ".", ".."} or "/" in name or "\0" in name:
        msg = f"{name!r} is not the name of a file; correct the file-name pattern"
        raise ExportError(msg, kind="name")


def _remove(token: str, staging_fd: int) -> None:
    with suppress(FileNotFoundError):
        os.unlink(token, dir_fd=staging_fd)


def _write_new(token: str, staging_fd: int, data: bytes, mode: int | None) -> None:
    """A failed fsync is never repeated: the file is given up with its descriptor."""
    fd = os.open(token, NEW_FILE_FLAGS, 0o666, dir_fd=staging_fd)
    try:
        _write_all(fd, data)
        if mode is not None:
            os.fchmod(fd, mode)
        os.fsync(fd)
    except OSError:
        with suppress(OSError):
            _remove(token, staging_fd)
        raise
    finally:
        os.close(fd)


def _write_all(fd: int, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(fd, rest) :]
