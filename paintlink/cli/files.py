"""Files the command line writes for its user."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from paintlink.errors import ExportError


def write_new(path: Path, data: bytes, *, replace: bool = False) -> None:
    """Write a file whole or not at all.

    Raises
    ------
    ExportError
        When it exists and may not be replaced, or the folder cannot be written.
    """
    with _whole(path, replace=replace) as temporary:
        temporary.write_bytes(data)


def write_lines(path: Path, lines: Iterable[str], *, replace: bool = False) -> None:
    """Write a UTF-8 text of any length whole or not at all; errors as `write_new`."""
    with (
        _whole(path, replace=replace) as temporary,
        temporary.open("w", encoding="utf-8", newline="") as file,
    ):
        file.writelines(lines)


@contextmanager
def _whole(path: Path, *, replace: bool) -> Iterator[Path]:
    """A place to write to; what is written there becomes the file on leaving."""
    if path.exists() and not replace:
        msg = f"{path} exists: choose another name, or remove it first"
        raise ExportError(msg)
    temporary = path.with_name(f".{path.name}.part")
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        msg = f"{path}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error
