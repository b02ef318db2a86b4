"""The control strip: twelve known patches that tell what a program did to a picture."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.sketch.values import PixelArray

LOW, HIGH = 0.2, 0.8
PATCHES = np.array([
    [0.0, 0.0, 0.0],
    [HIGH, LOW, LOW],
    [0.4, 0.4, 0.4],
    [LOW, HIGH, HIGH],
    [1.0, 1.0, 1.0],
    [HIGH, HIGH, LOW],
    [0.2, 0.2, 0.2],
    [LOW, LOW, HIGH],
    [0.8, 0.8, 0.8],
    [HIGH, LOW, HIGH],
    [0.6, 0.6, 0.6],
    [LOW, HIGH, LOW],
])
"""Encoded sRGB from left to right, in an order no mirror image repeats."""

LEFT, TOP = 0.02, 0.955
WIDTH, HEIGHT = 1.0 / 24.0, 1.0 / 40.0
CORE = 0.25
"""Share of a patch left out on each side when it is read: room for a blurred edge."""


def paint_strip(
    encoded: PixelArray, shift_px: tuple[float, float] = (0.0, 0.0)
) -> None:
    """Put the patches into a square picture, at the lower left."""
    places = _places(len(encoded), shift_px=shift_px)
    for place, patch in zip(places, PATCHES, strict=True):
        encoded[place] = patch


def read_strip(
    encoded: PixelArray, shift_px: tuple[float, float] = (0.0, 0.0)
) -> FloatArray:
    """Middle colour of each patch of a square picture, shape (12, 3).

    Patches out of the picture repeat its border.
    """
    places = _places(len(encoded), CORE, shift_px)
    return np.array([np.median(encoded[place], axis=(0, 1)) for place in places])


def strip_fits(size: int, shift_px: tuple[float, float]) -> bool:
    """Whether the strip still lies in a picture that was moved."""
    right, down = (one / size for one in shift_px)
    ends = (LEFT + right, LEFT + len(PATCHES) * WIDTH + right)
    return ends[0] >= 0.0 and ends[1] <= 1.0 and 0.0 <= TOP + down <= 1.0 - HEIGHT


def _places(
    size: int, core: float = 0.0, shift_px: tuple[float, float] = (0.0, 0.0)
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Rows and columns of the patches, less a share of each at either side."""
    right, down = shift_px
    rows = _span(TOP, HEIGHT, core, size, down)[:, np.newaxis]
    for index in range(len(PATCHES)):
        yield rows, _span(LEFT + index * WIDTH, WIDTH, core, size, right)


def _span(
    start: float, length: float, core: float, size: int, shift_px: float
) -> NDArray[np.intp]:
    first = round(size * (start + core * length) + shift_px)
    last = round(size * (start + (1.0 - core) * length) + shift_px)
    return np.clip(np.arange(first, max(last, first + 1)), 0, size - 1)
