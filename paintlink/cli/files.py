"""Files the command line writes for its user."""

from __future__ import annotations

from pathlib import Path

from paintlink.errors import ExportError


def write_new(path: Path, data: bytes, *, replace: bool = False) -> None:
    """Write a file whole or not at all.

    Raises
    ------
    ExportError
        When it exists and may not be replaced, or the folder cannot be written.
    """
    if path.exists() and not replace:
        msg = f"{path} exists: choose another name, or remove it first"
        raise ExportError(msg)
    temporary = path.with_name(f".{path.name}.part")
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        msg = f"{path}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error
