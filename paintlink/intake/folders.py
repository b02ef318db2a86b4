"""The folders a file passes through, and how it moves from one to the next."""

from __future__ import annotations

import errno
import os
import shutil
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from paintlink.errors import InputError
from paintlink.export import GUARD
from paintlink.export.rename import rename_noreplace
from paintlink.intake.safe import opened_folder

CARRIED = ".paintlink"
TRIES = 50


@dataclass(frozen=True, slots=True)
class InboxFolders:
    """The folders a file passes through, all below one site folder."""

    inbox: Path
    working: Path
    done: Path
    failed: Path
    duplicate: Path

    @classmethod
    def below(
        cls, site: Path, inbox: Path | None = None, *, within: str = ""
    ) -> InboxFolders:
        """Return the usual names below a site folder.

        ``within`` names a folder inside each of ``working``, ``done``, ``failed`` and
        ``duplicate``, so that several inboxes share them.
        """
        names = ("working", "done", "failed", "duplicate")
        return cls(inbox or site / "inbox", *(site / name / within for name in names))

    def create(self) -> None:
        """Make the folders that are missing."""
        for name in self.__slots__:
            getattr(self, name).mkdir(parents=True, exist_ok=True)


def require_share(folder: Path) -> None:
    """Refuse an empty mount point in the place of the share that belongs there.

    Raises
    ------
    InputError
        When the file that marks the share cannot be seen.
    """
    if not (folder / GUARD).exists():
        msg = (
            f"{folder}: {GUARD} is not there, so the share is not connected; mount it, "
            f"or create that file once on the share itself"
        )
        raise InputError(msg)


def free_name(name: str, folder: Path) -> str:
    """A name that is not taken in a folder: ``x.xml``, ``x-2.xml``, ..."""
    return next(one for one in _names(name) if not os.path.lexists(folder / one))


def move(name: str, source: Path, target: Path, wish: str = "") -> Path:
    """Place of a file moved into another folder under a name that was free there.

    ``wish`` is the name to try first; its own when left out.

    Raises
    ------
    OSError
        When it is gone, busy, or the folders lie on two file systems.
    """
    with opened_folder(source) as source_fd, opened_folder(target) as target_fd:
        for candidate in _names(wish or name):
            with suppress(FileExistsError):
                rename_noreplace(name, source_fd, candidate, target_fd)
                return target / candidate
    raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), name)


def carry(name: str, source: Path, target: Path) -> Path:
    """Place of a file brought over from another file system, durably.

    It is first moved aside on its own side, so that nobody writes into it or takes it
    while it is copied; what an interruption leaves there is carried by `left_behind`.
    """
    aside = source / CARRIED
    aside.mkdir(exist_ok=True)
    held = move(name, source, aside)
    return _copied(held, target)


def left_behind(source: Path, target: Path) -> Path | None:
    """Place of a file whose carrying had been interrupted; None when none was."""
    aside = source / CARRIED
    with suppress(FileNotFoundError):
        for held in sorted(aside.iterdir()):
            if not held.name.startswith("."):
                return _copied(held, target)
    return None


def _copied(held: Path, target: Path) -> Path:
    partial = target / f".{held.name}.part"
    shutil.copyfile(held, partial, follow_symlinks=False)
    if not partial.is_symlink():
        with partial.open("rb") as file:
            os.fsync(file.fileno())
    final = free_name(held.name, target)
    with opened_folder(target) as target_fd:
        os.rename(partial.name, final, src_dir_fd=target_fd, dst_dir_fd=target_fd)
        os.fsync(target_fd)
    held.unlink()
    return target / final


def _names(name: str) -> list[str]:
    """Names to try: ``x.xml``, ``x-2.xml``, ..., at last one that nobody has."""
    stem, suffix = Path(name).stem, Path(name).suffix
    numbered = [f"{stem}-{number}{suffix}" for number in range(2, TRIES)]
    return [name, *numbered, f"{stem}-{time.time_ns()}{suffix}"]
