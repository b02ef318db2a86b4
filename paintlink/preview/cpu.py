"""The reference: pictures drawn with numpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.color import into_gamut
from paintlink.color.display import encode_srgb
from paintlink.preview.arrays import Float32Array
from paintlink.preview.scene import Band
from paintlink.preview.strips import Strips

ROWS_AT_ONCE = 16
STEPS = 4096
CODES = (255.0 * encode_srgb((np.arange(STEPS) / (STEPS - 1)) ** 2)).astype(np.float32)
"""Encoded values of the squares of evenly spaced numbers: dense where it is dark."""


def draw(band: Band, strips: Strips) -> NDArray[np.uint8]:
    """Encoded picture of a band, shape (rows, columns, 3)."""
    _, rows, columns = band.planes.shape
    covered = strips.between_seams()
    picture = np.empty((rows, columns, 3), dtype=np.uint8)
    for ink, left, right in zip(
        strips.inks, strips.edges[:-1], strips.edges[1:], strict=True
    ):
        across = slice(left, right)
        for top in range(0, rows, ROWS_AT_ONCE):
            down = slice(top, top + ROWS_AT_ONCE)
            part = Band(band.planes[:, down, across], band.channels)
            picture[down, across] = _encoded(_linear(part, ink, covered[across]), part)
    return picture


def _linear(part: Band, ink: Float32Array, covered: Float32Array) -> Float32Array:
    """Object before backdrop, linear sRGB, shape (3, rows, columns)."""
    terms = part.planes[:-3].reshape(part.channels, part.terms, -1)
    paint = (ink.T[:, np.newaxis, :] @ terms).reshape(3, *part.planes.shape[1:])
    cover, backdrop = part.planes[-3] * covered, part.planes[-2]
    seen: Float32Array = backdrop + cover * (paint - backdrop)
    return seen


def _encoded(linear: Float32Array, part: Band) -> NDArray[np.uint8]:
    shown = into_gamut(np.moveaxis(linear, 0, -1))
    codes = CODES[np.rint(np.sqrt(shown) * (STEPS - 1)).astype(np.intp)]
    dither = part.planes[-1][..., np.newaxis]
    encoded: NDArray[np.uint8] = (codes + (dither + 0.5)).astype(np.uint8)
    return encoded
