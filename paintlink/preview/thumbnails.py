"""Small pictures of a whole library, many paints at a time."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.model import Gloss, PaintTable
from paintlink.preview import cpu, fused
from paintlink.preview.arrays import Float32Array
from paintlink.preview.basis import coefficients_of
from paintlink.preview.environment import load
from paintlink.preview.forms import form
from paintlink.preview.gloss import USUAL_ANGLE_DEG, roughness_of
from paintlink.preview.scene import Band, Scene, band

PAINTS_AT_ONCE = 128
PRODUCTS_AT_ONCE = 1 << 18
"""Above it OpenBLAS starts threads of its own, which are in the way of ours."""

SIZES = range(16, 257)


@dataclass(frozen=True)
class Sheet:
    """How thumbnails are drawn.

    Parameters
    ----------
    size
        Width and height in pixels, 16 to 256.
    """

    object: str = "sphere"
    light: str = "studio"
    size: int = 96
    cache_dir: Path | None = None

    def __post_init__(self) -> None:
        if self.size not in SIZES:
            msg = f"a thumbnail is {SIZES[0]} to {SIZES[-1]} pixels wide"
            raise PreviewError(f"{msg}, not {self.size}")


def thumbnails(
    table: PaintTable, rows: NDArray[np.intp], sheet: Sheet
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.uint8]]]:
    """Rows of the table and their pictures, shape (rows, size, size, 3), in turn.

    Drawn by numpy with all cores. Paints of the table that were measured without gloss
    get the usual one.
    """
    kinds, kind = _coats(table, rows)
    scene = Scene(
        form(sheet.object), load(sheet.light), sheet.size, kinds, sheet.cache_dir
    )
    (whole,) = scene.bands()
    prepared = band(scene, whole)
    blocks = [
        slice(start, start + PAINTS_AT_ONCE)
        for start in range(0, len(rows), PAINTS_AT_ONCE)
    ]

    draw = fused.draw if fused.available() else _draw

    def drawn(some: slice) -> NDArray[np.uint8]:
        paint = coefficients_of(table.angles_deg, table.lab[rows[some]], table.observer)
        coat = np.equal.outer(kind[some], np.arange(len(kinds)))
        white = np.repeat(coat[..., np.newaxis], 3, axis=2)
        return draw(prepared, np.concatenate([paint, white], axis=1).astype(np.float32))

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        waiting: deque[tuple[slice, Future[NDArray[np.uint8]]]] = deque()
        for some in blocks:
            waiting.append((some, pool.submit(drawn, some)))
            if len(waiting) > 2 * (os.cpu_count() or 1):
                done, future = waiting.popleft()
                yield rows[done], future.result()
        for done, future in waiting:
            yield rows[done], future.result()


def _coats(
    table: PaintTable, rows: NDArray[np.intp]
) -> tuple[tuple[float, ...], NDArray[np.intp]]:
    """Roughness of the coats the rows have, and which of them each row has."""
    unknown = np.full(len(table), np.nan)
    gloss = (unknown if table.gloss_gu is None else table.gloss_gu)[rows]
    known, which = np.unique(gloss, return_inverse=True)
    rough = [
        roughness_of(None if np.isnan(gu) else Gloss(float(gu), USUAL_ANGLE_DEG))
        for gu in known
    ]
    kinds = tuple(sorted(set(rough)))
    return kinds, np.array([kinds.index(value) for value in rough])[which]


def _draw(prepared: Band, inks: Float32Array) -> NDArray[np.uint8]:
    """Pictures of many paints, shape (paints, rows, columns, 3)."""
    codes = np.empty((3, len(inks), len(prepared.pixels)), dtype=np.uint8)
    few = max(1, PRODUCTS_AT_ONCE // max(prepared.light[0].size, 1))
    grain = np.tile(prepared.dither, few)
    for start in range(0, len(inks), few):
        some = slice(start, start + few)
        codes[:, some] = _codes(prepared, inks[some], grain)
    pictures = np.repeat(prepared.plain[np.newaxis], len(inks), axis=0)
    places = pictures.reshape(len(inks), -1, 3)
    for run in _runs(prepared.pixels):
        covered = slice(prepared.pixels[run][0], prepared.pixels[run][-1] + 1)
        for channel in range(3):
            places[:, covered, channel] = codes[channel, :, run]
    return pictures


def _codes(
    prepared: Band, inks: Float32Array, grain: Float32Array
) -> NDArray[np.uint8]:
    """Encoded colours of the covered pixels, shape (3, paints, n)."""
    paints, count = len(inks), len(prepared.pixels)
    seen = np.empty((3, paints, count), dtype=np.float32)
    for channel in range(3):
        light = prepared.light[channel % prepared.channels]
        np.matmul(inks[:, :, channel], light, out=seen[channel])
    seen -= prepared.behind
    seen *= prepared.cover
    seen += prepared.behind
    flat = seen.reshape(3, paints * count)
    cpu.into_gamut(flat)
    codes = cpu.encoded(flat, grain[: paints * count])
    return codes.reshape(3, paints, count)


def _runs(pixels: NDArray[np.intp]) -> list[slice]:
    """Stretches in which one pixel follows the other."""
    breaks = np.flatnonzero(np.diff(pixels) != 1) + 1
    edges = [0, *breaks.tolist(), len(pixels)]
    return [slice(first, last) for first, last in pairwise(edges) if first < last]
