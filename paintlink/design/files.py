"""Designs in files."""

from __future__ import annotations

import os
from pathlib import Path

from paintlink.design.design import Design
from paintlink.design.document import MAX_BYTES, from_json, to_json
from paintlink.errors import DesignError, ExportError


def read_design(path: Path) -> Design:
    """The design in a file.

    Raises
    ------
    DesignError
        When the file cannot be read or its content is refused, naming the file.
    """
    try:
        if not path.is_file():
            path.stat()
            msg = "not a regular file: name the design itself"
            raise DesignError(msg, source=str(path))
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        msg = f"cannot be read ({error.strerror}): `paintlink design new` makes one"
        raise DesignError(msg, source=str(path)) from error
    return from_json(data, source=str(path))


def write_design(path: Path, design: Design) -> None:
    """Write the design whole or not at all; an older one is replaced.

    Raises
    ------
    ExportError
        When the folder cannot be written.
    """
    data = to_json(design)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
        _sync(path.parent)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        msg = f"{path}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error


def _sync(folder: Path) -> None:
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
