"""Pictures of 8 or 16 bits a channel as PNG files, and numbers that are no colours."""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from paintlink.preview.arrays import Float32Array

Codes = NDArray[np.uint8] | NDArray[np.uint16]
"""Samples as they stand in a file, shape (height, width, 3)."""

SIGNATURE = b"\x89PNG\r\n\x1a\n"
TRUE_COLOUR = 2
PERCEPTUAL = 0
GAMMA = 45455
FILTER_UP = 2
EFFORT = 3


def to_codes(values: Float32Array, bits: int) -> Codes:
    """Values of 0 to 1 as integers of 8 or 16 bits."""
    codes: Codes = np.empty(values.shape, dtype=np.uint8 if bits == 8 else np.uint16)
    for row, line in zip(codes, values, strict=True):
        row[:] = line * np.float32(most(bits)) + np.float32(0.5)
    return codes


def to_values(codes: Codes) -> Float32Array:
    """The integers of a file as values of 0 to 1."""
    values = codes.astype(np.float32)
    values /= np.float32(most(8 * codes.dtype.itemsize))
    return values


def most(bits: int) -> int:
    """Largest integer of a sample."""
    return (1 << bits) - 1


def sample_bytes(codes: Codes) -> bytes:
    """The samples row by row, big-endian: what the digests of a recipe are made of."""
    return codes.astype(codes.dtype.newbyteorder(">")).tobytes()


def to_png(codes: Codes, text: str, *, srgb: bool) -> bytes:
    """A PNG file with a text under the keyword ``paintlink``.

    Parameters
    ----------
    srgb
        Whether the samples are colours. Numbers go without any chunk on colours, so
        that no program converts them.

    References
    ----------
    W3C, Portable Network Graphics (PNG) Specification, Third Edition.
    """
    height, width, _ = codes.shape
    bits = 8 * codes.dtype.itemsize
    header = struct.pack(">IIBBBBB", width, height, bits, TRUE_COLOUR, 0, 0, 0)
    colour = [
        _chunk(b"sRGB", bytes([PERCEPTUAL])),
        _chunk(b"gAMA", struct.pack(">I", GAMMA)),
    ]
    chunks = [
        _chunk(b"IHDR", header),
        *(colour if srgb else []),
        _chunk(b"iTXt", b"paintlink\0\0\0\0\0" + text.encode()),
        _chunk(b"IDAT", zlib.compress(_scanlines(codes), EFFORT)),
        _chunk(b"IEND", b""),
    ]
    return SIGNATURE + b"".join(chunks)


def _scanlines(codes: Codes) -> bytes:
    """Each row as its difference to the row above, which compresses well."""
    rows = np.frombuffer(sample_bytes(codes), dtype=np.uint8).reshape(len(codes), -1)
    lines = np.empty((len(rows), rows.shape[1] + 1), dtype=np.uint8)
    lines[:, 0] = FILTER_UP
    lines[0, 1:] = rows[0]
    np.subtract(rows[1:], rows[:-1], out=lines[1:, 1:])
    return lines.tobytes()


def _chunk(kind: bytes, data: bytes) -> bytes:
    checksum = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)
