"""The reference: pictures drawn with numpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.color.display import LUMINANCE, SHOULDER_FROM, encode_srgb
from paintlink.preview.arrays import Float32Array
from paintlink.preview.scene import Band

PIXELS_AT_ONCE = 8192
STEPS = 4096
CODES = (255.0 * encode_srgb((np.arange(STEPS) / (STEPS - 1)) ** 2)).astype(np.float32)
"""Encoded values of the squares of evenly spaced numbers: dense where it is dark."""

TOO_CHROMATIC, TOO_BRIGHT = 1, 2
TOLERANCE = np.float32(1e-4)
START = np.float32(SHOULDER_FROM)
ROOM = np.float32(1.0) - START
GREY = LUMINANCE.astype(np.float32)


def draw(band: Band, inks: Float32Array) -> NDArray[np.uint8]:
    """Encoded colour of the covered pixels, and whether sRGB can show it, (4, n).

    Parameters
    ----------
    inks
        What to multiply the light of each term with, shape (paints, terms, 3).

    Returns
    -------
    Red, green, blue, and 0 or the sum of ``TOO_CHROMATIC`` and ``TOO_BRIGHT``.
    """
    count = len(band.pixels)
    drawn = np.empty((4, count), dtype=np.uint8)
    for start in range(0, count, PIXELS_AT_ONCE):
        some = slice(start, start + PIXELS_AT_ONCE)
        seen = radiance(band, inks, some)
        drawn[3, some] = into_gamut(seen)
        drawn[:3, some] = encoded(seen, band.dither[some])
    return drawn


def radiance(band: Band, inks: Float32Array, some: slice) -> Float32Array:
    """Object before backdrop in some covered pixels, linear sRGB, shape (3, n)."""
    light = band.light[:, :, some]
    seen = _weighed(light, inks[0])
    for number, ink in enumerate(inks[1:], start=1):
        np.copyto(seen, _weighed(light, ink), where=band.part[some] == number)
    behind = band.behind[some]
    seen -= behind
    seen *= band.cover[some]
    seen += behind
    return seen


def into_gamut(linear: Float32Array) -> NDArray[np.uint8]:
    """Change colours as `paintlink.color.into_gamut` does, in place; say which and why.

    Parameters
    ----------
    linear
        Shape (3, n).
    """
    lowest = linear.min(axis=0)
    flags: NDArray[np.uint8] = (lowest < -TOLERANCE).astype(np.uint8)
    if lowest.min(initial=0.0) < 0.0:
        _desaturate(linear, lowest)
    peak = linear.max(axis=0)
    flags += TOO_BRIGHT * (peak > 1.0 + TOLERANCE).astype(np.uint8)
    np.maximum(peak, START, out=peak)
    scale = np.exp((START - peak) / ROOM)
    scale *= -ROOM
    scale += 1.0
    scale /= peak
    linear *= scale
    np.clip(linear, 0.0, 1.0, out=linear)
    return flags


def _desaturate(linear: Float32Array, lowest: Float32Array) -> None:
    """Mix colours with the grey of their luminance until none is negative."""
    luminance = GREY @ linear
    keep = luminance / np.maximum(luminance - np.minimum(lowest, 0.0), 1e-9)
    np.clip(keep, 0.0, 1.0, out=keep)
    linear -= luminance
    linear *= keep
    linear += luminance


def _weighed(light: Float32Array, ink: Float32Array) -> Float32Array:
    if len(light) == 1:
        neutral: Float32Array = ink.T @ light[0]
        return neutral
    return np.stack([ink[:, channel] @ light[channel] for channel in range(3)])


def encoded(shown: Float32Array, dither: Float32Array) -> NDArray[np.uint8]:
    """Codes of colours within 0 to 1, shape (3, n); changes ``shown``."""
    np.sqrt(shown, out=shown)
    shown *= STEPS - 1
    shown += np.float32(0.5)
    codes = CODES.take(shown.astype(np.int32))
    codes += dither + np.float32(0.5)
    return codes.astype(np.uint8)
