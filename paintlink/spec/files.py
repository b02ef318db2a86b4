"""Colour specifications in files."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from paintlink.errors import SpecError
from paintlink.model import ColorSpec
from paintlink.spec.document import MAX_BYTES, require_small
from paintlink.spec.reader import read_spec


def read_spec_file(path: Path | str) -> ColorSpec:
    """Colour specification in a regular file of at most 1 MiB.

    Raises
    ------
    SpecError
        When the file cannot be read or its content is refused, naming the file.
    """
    source = str(path)
    try:
        data = _content(source)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        msg = f"cannot be read ({reason}): name an XML file that exists and is readable"
        raise SpecError(msg, source=source) from error
    return read_spec(data, source=source)


def _content(source: str) -> bytes:
    """Bytes of the file; one more than allowed when it is growing."""
    with open(source, "rb", opener=_open_at_once) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            msg = "not a regular file: name the XML file itself"
            raise SpecError(msg, source=source)
        require_small(status.st_size, source)
        return file.read(MAX_BYTES + 1)


def _open_at_once(path: str, flags: int) -> int:
    """Descriptor of the file, without waiting for the writer of a FIFO."""
    return os.open(path, flags | os.O_NONBLOCK)
