"""Where a frame ends: functions from the bytes so far to the size of one frame."""

from __future__ import annotations

import re
from collections.abc import Callable

_LINE = re.compile(rb"\s*\S[^\r\n]*(?:\r\n|\r|\n)")


def line_size(buffer: bytes) -> int:
    """Return the size of the first line that is not blank, 0 when it is incomplete.

    A line ends in CR, LF or CR LF. The white space before it counts to it, so that an
    LF that arrives later than its CR never makes a line of its own.
    """
    match = _LINE.match(buffer)
    return match.end() if match else 0


def up_to(pattern: bytes) -> Callable[[bytes], int]:
    """Return a function that ends a frame where ``pattern`` first matches."""
    search = re.compile(pattern).search

    def size(buffer: bytes) -> int:
        match = search(buffer)
        return match.end() if match else 0

    return size


def fixed(size: int, accept: Callable[[bytes], bool]) -> Callable[[bytes], int]:
    """Return a function that ends a frame after ``size`` bytes that ``accept`` likes.

    Whatever stands in front of them is passed over: take the last ``size`` bytes of
    what `Link.receive` returns.
    """

    def end(buffer: bytes) -> int:
        for stop in range(size, len(buffer) + 1):
            if accept(buffer[stop - size : stop]):
                return stop
        return 0

    return end
