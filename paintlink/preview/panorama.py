"""Photographed light: the user's Radiance (.hdr) and OpenEXR (.exr) panoramas."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from paintlink.errors import PreviewError
from paintlink.model import FloatArray
from paintlink.preview import rgbe
from paintlink.preview.arrays import Float32Array

SUFFIXES = (".hdr", ".exr")
MOST_BYTES = 512 << 20
MOST_TEXELS = 16384 * 8192
WORKING_SIZE = (1024, 2048)
BRIGHTEST = 1e9


def load(path: Path) -> Float32Array:
    """Linear sRGB of a latitude-longitude panorama, shape (height, width, 3).

    The middle column lies straight ahead of the viewer's back: what a photographer
    standing in the object's place and looking away from the viewer has in the middle
    of the picture. Large panoramas are reduced, with their light kept.

    Raises
    ------
    PreviewError
        When the file cannot be read or does not hold light from all around.
    """
    try:
        size = path.stat().st_size
    except OSError as error:
        msg = f"cannot read the light {path}: {error.strerror}"
        raise PreviewError(msg) from error
    if size > MOST_BYTES:
        msg = f"{path} has {size >> 20} MiB, more than {MOST_BYTES >> 20}: reduce it"
        raise PreviewError(msg)
    read = rgbe.read if path.suffix.lower() == ".hdr" else _read_exr
    try:
        texels = read(path)
    except (OSError, ValueError) as error:
        msg = f"{path} is no panorama that can be read ({error})"
        raise PreviewError(msg) from error
    return _reduced(_checked(texels, path))


def radiance_of(texels: Float32Array) -> Callable[[Float32Array], Float32Array]:
    """Function of unit directions, shape (n, 3), that gives their radiance, (n, 3)."""

    def radiance(directions: Float32Array) -> Float32Array:
        height, width, _ = texels.shape
        polar = np.arccos(np.clip(directions[:, 1], -1.0, 1.0))
        azimuth = np.arctan2(directions[:, 0], -directions[:, 2])
        row = np.clip(polar / np.pi * height - 0.5, 0.0, height - 1.0)
        column = (azimuth / (2.0 * np.pi) + 0.5) * width - 0.5
        return _interpolated(texels, row, column)

    return radiance


def _interpolated(
    texels: Float32Array, row: FloatArray, column: FloatArray
) -> Float32Array:
    height, width, _ = texels.shape
    top = np.minimum(row.astype(np.intp), height - 2)
    left = np.floor(column).astype(np.intp)
    down = (row - top).astype(np.float32)[:, None]
    right = (column - left).astype(np.float32)[:, None]
    left, after = left % width, (left + 1) % width
    upper = texels[top, left] * (1 - right) + texels[top, after] * right
    lower = texels[top + 1, left] * (1 - right) + texels[top + 1, after] * right
    mixed: Float32Array = upper + (lower - upper) * down
    return mixed


def _checked(texels: Float32Array, path: Path) -> Float32Array:
    height, width = texels.shape[:2]
    if width != 2 * height or height < 4:
        msg = (
            f"{path} is {width} x {height} texels: a panorama is twice as wide as "
            "high, convert it to the latitude-longitude (equirectangular) layout"
        )
        raise PreviewError(msg)
    if not np.isfinite(texels).all() or texels.max(initial=0.0) > BRIGHTEST:
        msg = f"{path} holds light that is not a number: export it again"
        raise PreviewError(msg)
    if texels.max(initial=0.0) <= 0.0:
        msg = f"{path} is black everywhere: it lights nothing"
        raise PreviewError(msg)
    return np.maximum(texels, 0.0).astype(np.float32)


def _reduced(texels: Float32Array) -> Float32Array:
    height, width, _ = texels.shape
    step = height // WORKING_SIZE[0]
    if step < 2:
        return texels
    trimmed = texels[: height // step * step, : width // step * step]
    blocks = trimmed.reshape(height // step, step, width // step, step, 3)
    mean: Float32Array = blocks.mean(axis=(1, 3), dtype=np.float32)
    return mean


def _read_exr(path: Path) -> Float32Array:
    try:
        import OpenEXR
    except ImportError as error:
        msg = "to read OpenEXR, install paintlink with its extra: [exr]"
        raise ValueError(msg) from error
    try:
        with OpenEXR.File(str(path)) as file:
            channels = file.channels()
            name = next((n for n in ("RGB", "RGBA") if n in channels), None)
            if name is None:
                msg = f"no RGB channels but {', '.join(channels) or 'none'}"
                raise ValueError(msg)
            texels = np.array(channels[name].pixels[..., :3], dtype=np.float32)
    except ValueError:
        raise
    except Exception as error:
        raise ValueError(str(error) or type(error).__name__) from error
    if texels.shape[0] * texels.shape[1] > MOST_TEXELS:
        msg = f"{texels.shape[1]} x {texels.shape[0]} texels are too many"
        raise ValueError(msg)
    return texels
