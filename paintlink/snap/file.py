"""Trees kept in files: derived from a library, mapped into memory, never trusted.

A file holds one tree. Its header names the state of the library it was built from,
and every byte is checked before the first search; a file that fails is refused.

Layout, little-endian: MAGIC, length of the header (uint64), CRC-32 of the header
(uint32), four zero bytes, the header (JSON), then the arrays, each at a multiple of
64 bytes.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import struct
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import IndexFileError
from paintlink.snap.boxes import Box
from paintlink.snap.conditions import Conditions
from paintlink.snap.stock import Stock
from paintlink.snap.tree import Tree

MAGIC = b"PLSNAP01"
PREFIX = struct.Struct("<8sQII")
ALIGNED = 64
DTYPES = ("<f4", "<i2", "<f8", "<i4")
log = logging.getLogger(__name__)

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True, slots=True)
class Key:
    """What a tree was built from: another library, state or angle set differs."""

    library: str
    generation: str
    conditions: Conditions
    space: str
    content: str

    def document(self) -> dict[str, Any]:
        """As JSON."""
        return {
            "library": self.library,
            "generation": self.generation,
            "angles_deg": list(self.conditions.angles_deg),
            "estimated_deg": list(self.conditions.estimated_deg),
            "space": self.space,
            "content": self.content,
        }

    @property
    def file_name(self) -> str:
        """One file for each library, angle set and space; states replace each other."""
        document = self.document()
        del document["generation"], document["content"]
        text = json.dumps(document, sort_keys=True).encode()
        return f"{hashlib.sha256(text).hexdigest()[:20]}.snap"


def content_of(stock: Stock) -> str:
    """Hash of ids and Lab: a generation that was reused cannot mislead."""
    digest = hashlib.blake2b(digest_size=16)
    for array in (stock.ids, stock.planes):
        digest.update(np.ascontiguousarray(array).data)
    return digest.hexdigest()


def kept_tree(folder: Path, key: Key, build: Callable[[], Tree]) -> Tree:
    """The tree of a folder; one that is missing or refused is built and written.

    Nothing here can fail: without the file, searching goes on.
    """
    path = folder / key.file_name
    try:
        return read_tree(path, key)
    except IndexFileError as error:
        if path.exists():
            log.warning("%s", error)
    tree = build()
    try:
        write_tree(path, tree, key)
    except IndexFileError as error:
        log.warning("%s; searching goes on without it", error)
    return tree


def write_tree(path: Path, tree: Tree, key: Key) -> None:
    """Write a tree whole or not at all.

    Raises
    ------
    IndexFileError
        When the folder cannot be written.
    """
    header, payload = _encoded(tree, key)
    prefix = PREFIX.pack(MAGIC, len(header), zlib.crc32(header), 0)
    start = prefix + header
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with temporary.open("wb") as file:
            file.write(start.ljust(_aligned(len(start)), b"\0"))
            for array in payload:
                data = array.tobytes()
                file.write(data.ljust(_aligned(len(data)), b"\0"))
        temporary.replace(path)
    except OSError as error:
        with suppress(OSError):
            temporary.unlink()
        msg = f"search index {path} cannot be written: {error.strerror}"
        raise IndexFileError(msg) from error


def read_tree(path: Path, key: Key) -> Tree:
    """The tree in a file, mapped into memory.

    Raises
    ------
    IndexFileError
        When the file is missing, damaged, or of another state of the library; says
        which, and that building it anew is the cure.
    """
    try:
        data = np.memmap(path, dtype=np.uint8, mode="r")
    except (OSError, ValueError) as error:
        raise _refused(path, f"cannot be read ({error})") from error
    header, start = _header(path, data)
    found, wanted = header.get("key"), key.document()
    if found != wanted:
        raise _refused(path, f"is of another state: {found}, wanted {wanted}")
    try:
        arrays = dict(_arrays(data, header, start))
        return _tree(arrays)
    except (KeyError, TypeError, ValueError) as error:
        raise _refused(path, f"is damaged ({error})") from error


def _refused(path: Path, why: str) -> IndexFileError:
    return IndexFileError(f"search index {path} {why}: delete it, it is built anew")


def _aligned(size: int) -> int:
    return -(-size // ALIGNED) * ALIGNED


def _encoded(tree: Tree, key: Key) -> tuple[bytes, list[NDArray[Any]]]:
    entries, payload, offset = [], [], 0
    for name, array in _named(tree).items():
        stored = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
        entries.append({
            "name": name,
            "dtype": stored.dtype.str,
            "shape": list(stored.shape),
            "offset": offset,
            "crc32": zlib.crc32(stored.data),
        })
        payload.append(stored)
        offset += _aligned(stored.nbytes)
    document = {"key": key.document(), "arrays": entries, "bytes": offset}
    return json.dumps(document, sort_keys=True).encode(), payload


def _named(tree: Tree) -> Arrays:
    return {
        "upper_low": tree.upper.low,
        "upper_high": tree.upper.high,
        "leaves_low": tree.leaves.low,
        "leaves_high": tree.leaves.high,
        "points": tree.points,
        "rows": tree.rows,
    }


def _tree(arrays: Arrays) -> Tree:
    return Tree(
        upper=Box(arrays["upper_low"], arrays["upper_high"]),
        leaves=Box(arrays["leaves_low"], arrays["leaves_high"]),
        points=arrays["points"],
        rows=arrays["rows"],
    )


def _header(path: Path, data: NDArray[np.uint8]) -> tuple[dict[str, Any], int]:
    """The header, and where the arrays start."""
    if len(data) < PREFIX.size:
        raise _refused(path, "is cut short")
    magic, length, crc, _ = PREFIX.unpack(data[: PREFIX.size].tobytes())
    if magic != MAGIC:
        raise _refused(path, f"starts with {magic!r}, not {MAGIC!r}")
    text = data[PREFIX.size : PREFIX.size + length].tobytes()
    if len(text) != length or zlib.crc32(text) != crc:
        raise _refused(path, "has a damaged header")
    header: dict[str, Any] = json.loads(text)
    start = _aligned(PREFIX.size + length)
    if len(data) != start + header["bytes"]:
        raise _refused(path, f"has {len(data)} bytes, not {start + header['bytes']}")
    return header, start


def _arrays(
    data: NDArray[np.uint8], header: dict[str, Any], start: int
) -> Iterator[tuple[str, NDArray[Any]]]:
    for entry in header["arrays"]:
        dtype = np.dtype(entry["dtype"])
        if dtype.str not in DTYPES:
            msg = f"{entry['name']} has the type {dtype.str}"
            raise ValueError(msg)
        size = int(np.prod(entry["shape"])) * dtype.itemsize
        first = start + int(entry["offset"])
        part = data[first : first + size]
        if zlib.crc32(part.data) != entry["crc32"]:
            msg = f"check sum of {entry['name']} is wrong"
            raise ValueError(msg)
        yield entry["name"], part.view(dtype).reshape(entry["shape"])
