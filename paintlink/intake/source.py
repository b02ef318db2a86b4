"""The bytes of a file of unknown origin, and careful views of them."""

from __future__ import annotations

import os
import stat
from functools import cached_property
from pathlib import Path

from paintlink.errors import InputError
from paintlink.instrument import quoted
from paintlink.intake.text import Decoded, decode

MAX_BYTES = 32 << 20
"""Ten thousand readings in the wordiest format; enough of an attack to bear."""

HEAD_BYTES = 4096
MAX_LINES = 1_000_000


class Source:
    """A file in memory.

    Parameters
    ----------
    name
        What messages call it.
    data
        At most 32 MiB.
    """

    def __init__(self, name: str, data: bytes) -> None:
        self.name = name
        self.data = data
        if len(data) > MAX_BYTES:
            raise self.fault("", f"larger than {MAX_BYTES >> 20} MiB: split the export")
        if not data.strip():
            raise self.fault("", "the file is empty: export it again")

    @cached_property
    def decoded(self) -> Decoded:
        """The text of the file, and how it was decoded.

        Raises
        ------
        InputError
            When it is no text.
        """
        try:
            return decode(self.data)
        except InputError as error:
            raise self.fault("", str(error)) from error

    @property
    def text(self) -> str:
        """The text of the file."""
        return self.decoded.text

    def lines(self) -> list[str]:
        """The lines of the text.

        Raises
        ------
        InputError
            When they are more than any export has: each costs more than its letters.
        """
        if self.text.count("\n") + self.text.count("\r") > MAX_LINES:
            raise self.fault("", f"more than {MAX_LINES} lines: split the export")
        return self.text.splitlines()

    @cached_property
    def head(self) -> str:
        """The beginning of the text; empty for a file that is no text."""
        try:
            return decode(self.data[:HEAD_BYTES], cut=True).text.lstrip("\ufeff \t\r\n")
        except InputError:
            return ""

    def fault(self, where: str, what: str, value: object = None) -> InputError:
        """The refusal of this file: the place, what is wrong, what to do, the value."""
        place = f"{self.name}, {where}" if where else self.name
        found = "" if value is None else f" (found {quoted(str(value))})"
        return InputError(f"{place}: {what}{found}")


def open_source(path: Path) -> Source:
    """A regular file in memory.

    Raises
    ------
    InputError
        When there is none that can be read, it is too large, or empty.
    """
    try:
        with open(path, "rb", opener=_open_at_once) as file:
            status = os.fstat(file.fileno())
            if not stat.S_ISREG(status.st_mode):
                msg = f"{path}: not a regular file: name the file itself"
                raise InputError(msg)
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        msg = f"{path}: cannot be read ({reason}): name a file that exists"
        raise InputError(msg) from error
    return Source(str(path), data)


def _open_at_once(path: str, flags: int) -> int:
    """Descriptor of the file, without waiting for the writer of a FIFO."""
    return os.open(path, flags | os.O_NONBLOCK)
