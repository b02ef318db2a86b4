"""Radiance pictures (.hdr): bytes with a shared exponent.

Format: Ward, Real Pixels, in Graphics Gems II (1991); file header and run lengths as in
the Radiance reference, section "Radiance file formats".
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from paintlink.preview.arrays import Float32Array

MAGIC = (b"#?RADIANCE", b"#?RGBE")
MOST_TEXELS = 16384 * 8192
RUN = 128


def read(path: Path) -> Float32Array:
    """Linear sRGB, shape (height, width, 3).

    Raises
    ------
    ValueError
        When the file is not a whole RGBE picture with its first row on top.
    """
    data = path.read_bytes()
    if not data.startswith(MAGIC):
        msg = "it does not begin as a Radiance picture does"
        raise ValueError(msg)
    header, found, rest = data.partition(b"\n\n")
    if not found or b"FORMAT=32-bit_rle_rgbe" not in header:
        msg = "it is not in the format 32-bit_rle_rgbe"
        raise ValueError(msg)
    size, found, texels = rest.partition(b"\n")
    match = re.fullmatch(rb"-Y (\d{1,6}) \+X (\d{1,6})", size.strip())
    if not match:
        msg = "its resolution line is not '-Y height +X width'"
        raise ValueError(msg)
    height, width = int(match[1]), int(match[2])
    if not 0 < height * width <= MOST_TEXELS:
        msg = f"{width} x {height} texels are none or too many"
        raise ValueError(msg)
    return _colours(_rows(texels, height, width))


def _colours(texels: NDArray[np.uint8]) -> Float32Array:
    exponent = texels[..., 3:].astype(np.int32)
    scale = np.ldexp(np.float32(1.0), exponent - (128 + 8)).astype(np.float32)
    colours = texels[..., :3] * np.where(exponent > 0, scale, 0)
    return colours.astype(np.float32)


def _rows(data: bytes, height: int, width: int) -> NDArray[np.uint8]:
    if not _run_length_coded(data, width):
        plain = np.frombuffer(data, np.uint8)
        if plain.size < height * width * 4:
            msg = "it is cut short"
            raise ValueError(msg)
        return plain[: height * width * 4].reshape(height, width, 4)
    rows: NDArray[np.uint8] = np.empty((height, 4, width), dtype=np.uint8)
    place = 0
    for row in rows:
        if not _run_length_coded(data[place : place + 4], width):
            msg = "a row is cut short or has another width"
            raise ValueError(msg)
        place += 4
        for component in row:
            place = _component(data, place, component)
    return rows.transpose(0, 2, 1)


def _run_length_coded(data: bytes, width: int) -> bool:
    marker = bytes([2, 2, width >> 8 & 0xFF, width & 0xFF])
    return 8 <= width < 1 << 15 and data[:4] == marker


def _component(data: bytes, place: int, into: NDArray[np.uint8]) -> int:
    """Fill one component of a row; where the next one begins."""
    filled = 0
    while filled < len(into):
        count = data[place] if place < len(data) else 0
        run = count > RUN
        length = count - RUN if run else count
        taken = data[place + 1 : place + 2 + (0 if run else length - 1)]
        if not length or filled + length > len(into) or not taken:
            msg = "a run of texels is damaged"
            raise ValueError(msg)
        if not run and len(taken) < length:
            msg = "it is cut short"
            raise ValueError(msg)
        values = np.frombuffer(taken, np.uint8)
        into[filled : filled + length] = values
        filled += length
        place += 1 + len(taken)
    return place
