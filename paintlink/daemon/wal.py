"""Commits that SQLite would drop without a word because its log was damaged.

SQLite takes the first frame with a wrong checksum for the end of the log. After a power
cut that is right: what follows had not been synced. A bit that flipped later cuts off
commits that had been, and those readings were acknowledged.

The layout of log and index: https://sqlite.org/fileformat2.html#the_write_ahead_log and
https://sqlite.org/walformat.html
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

HEADER_BYTES = 32
FRAME_HEADER_BYTES = 24
VALID_FRAMES_AT = 16  # place of mxFrame in the index
BIG_ENDIAN_MAGIC = 0x377F0683


def damage(journal: Path) -> str | None:
    """What is wrong with the log of an opened journal; None when nothing is.

    One unsynced transaction may follow the last valid one: that is what a power cut
    leaves. Two cannot, because the first was synced before the second began.
    """
    log, index = (journal.with_name(journal.name + end) for end in ("-wal", "-shm"))
    try:
        data, valid = log.read_bytes(), _valid_frames(index)
    except FileNotFoundError:
        return None
    if len(data) <= HEADER_BYTES + FRAME_HEADER_BYTES:
        return None
    if not _header_is_whole(data):
        return "the header of its log is damaged"
    commits = [number for number in _commits(data) if number > valid]
    if len(commits) > 1:
        return f"its log is damaged after frame {valid} of {commits[-1]}"
    return None


def _valid_frames(index: Path) -> int:
    with index.open("rb") as file:
        file.seek(VALID_FRAMES_AT)
        return int(struct.unpack("=I", file.read(4))[0])


def _header_is_whole(data: bytes) -> bool:
    magic = struct.unpack_from(">I", data)[0]
    order = ">" if magic == BIG_ENDIAN_MAGIC else "<"
    words = struct.unpack_from(f"{order}6I", data)
    first = second = 0
    for one, two in zip(words[::2], words[1::2], strict=True):
        first = (first + one + second) & 0xFFFFFFFF
        second = (second + two + first) & 0xFFFFFFFF
    return struct.unpack_from(">2I", data, 24) == (first, second)


def _commits(data: bytes) -> Iterator[int]:
    """Numbers of the frames, from 1, that end a transaction of this log."""
    page_bytes = struct.unpack_from(">I", data, 8)[0]
    salts = data[16:24]
    step = FRAME_HEADER_BYTES + page_bytes
    for number, at in enumerate(range(HEADER_BYTES, len(data) - step + 1, step), 1):
        size_after = struct.unpack_from(">I", data, at + 4)[0]
        if size_after and data[at + 8 : at + 16] == salts:
            yield number
