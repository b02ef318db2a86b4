"""Thumbnails compiled by numba where it is installed: the same steps as in `cpu`."""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.preview import cpu
from paintlink.preview.arrays import Float32Array
from paintlink.preview.scene import Band

BLOCK = 256


def available() -> bool:
    """Whether the extra is installed."""
    return find_spec("numba") is not None


def draw(prepared: Band, inks: Float32Array) -> NDArray[np.uint8]:
    """Pictures of many paints, shape (paints, rows, columns, 3).

    Parameters
    ----------
    inks
        Shape (paints, terms, 3), coats included.
    """
    pictures = np.repeat(prepared.plain[np.newaxis], len(inks), axis=0)
    light = np.broadcast_to(prepared.light, (3, *prepared.light.shape[1:]))
    _kernel()(
        np.ascontiguousarray(light) if prepared.channels == 3 else prepared.light,
        np.stack([prepared.cover, prepared.behind, prepared.dither]),
        prepared.pixels,
        np.ascontiguousarray(inks.transpose(0, 2, 1)),
        cpu.CODES,
        pictures.reshape(len(inks), -1, 3),
    )
    return pictures


@cache
def _kernel() -> Any:
    import numba

    compiled: Any = numba.njit(nogil=True, cache=True)(_draw)
    return compiled


def _draw(
    light: Any, frame: Any, pixels: Any, inks: Any, table: Any, pictures: Any
) -> None:
    one, zero, room = np.float32(1.0), np.float32(0.0), np.float32(0.2)
    start = np.float32(0.8)
    steps, half = np.float32(len(table) - 1), np.float32(0.5)
    luma = np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
    seen = np.empty((3, BLOCK), dtype=np.float32)
    neutral = light.shape[0] == 1
    for paint in range(inks.shape[0]):
        for first in range(0, pixels.shape[0], BLOCK):
            count = min(BLOCK, pixels.shape[0] - first)
            for channel in range(3):
                row = seen[channel]
                row[:] = zero
                source = light[0 if neutral else channel]
                for term in range(inks.shape[2]):
                    ink = inks[paint, channel, term]
                    if ink != zero:
                        plane = source[term, first : first + count]
                        for j in range(count):
                            row[j] += ink * plane[j]
            for j in range(count):
                cover, behind = frame[0, first + j], frame[1, first + j]
                r = behind + cover * (seen[0, j] - behind)
                g = behind + cover * (seen[1, j] - behind)
                b = behind + cover * (seen[2, j] - behind)
                lowest = min(r, min(g, b))
                if lowest < zero:
                    y = luma[0] * r + luma[1] * g + luma[2] * b
                    keep = y / max(y - lowest, np.float32(1e-9))
                    keep = min(max(keep, zero), one)
                    r, g, b = y + keep * (r - y), y + keep * (g - y), y + keep * (b - y)
                peak = max(r, max(g, b))
                if peak > start:
                    scale = (one - room * np.exp((start - peak) / room)) / peak
                    r, g, b = r * scale, g * scale, b * scale
                grain = frame[2, first + j] + half
                place = pictures[paint, pixels[first + j]]
                r = np.sqrt(min(max(r, zero), one)) * steps + half
                g = np.sqrt(min(max(g, zero), one)) * steps + half
                b = np.sqrt(min(max(b, zero), one)) * steps + half
                place[0] = np.uint8(table[np.int32(r)] + grain)
                place[1] = np.uint8(table[np.int32(g)] + grain)
                place[2] = np.uint8(table[np.int32(b)] + grain)
