"""What surrounds the object: a light file brought to the fixed exposure."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from importlib import import_module
from pathlib import Path

import numpy as np

from paintlink.color.display import LUMINANCE
from paintlink.model import FloatArray
from paintlink.preview import lights, panorama
from paintlink.preview.arrays import Float32Array
from paintlink.preview.names import find

Radiance = Callable[[Float32Array], Float32Array]

GRID = (256, 512)
WIDEST_LAMP = 8
MOST_OF_A_LAMP = 1 / 1500
EXPOSED_NORMAL = np.array([0.0, 0.5**0.5, 0.5**0.5], dtype=np.float32)


@dataclass(frozen=True)
class Environment:
    """A light around the object.

    Parameters
    ----------
    radiance
        Takes unit directions, shape (n, 3), x right, y up, z towards the viewer;
        gives linear sRGB radiance, shape (n, 3), on any scale.
    """

    name: str
    label: str
    radiance: Radiance

    @cached_property
    def grid(self) -> Float32Array:
        """Radiance of the latitude-longitude grid as the file gives it, (h, w, 3)."""
        directions, _ = latitude_longitude()
        return self.radiance(directions).reshape(*GRID, 3)

    @cached_property
    def channels(self) -> int:
        """1 when red, green and blue are equal everywhere, else 3."""
        neutral = (self.grid == self.grid[..., :1]).all()
        return 1 if neutral else 3

    @cached_property
    def exposure(self) -> float:
        """Factor that gives a perfect diffuser leaning back 45 degrees luminance 1."""
        directions, solid_angle = latitude_longitude()
        cosine = np.maximum(directions @ EXPOSED_NORMAL, 0.0)
        luminance = self.grid.reshape(-1, 3) @ LUMINANCE
        return float(np.pi / np.sum(luminance * solid_angle * cosine))

    @cached_property
    def digest(self) -> str:
        """Hash of what this light is, whatever its file is called."""
        return hashlib.sha256(self.grid.tobytes()).hexdigest()

    def seen_along(self, directions: Float32Array) -> Float32Array:
        """Exposed radiance, shape (n, channels)."""
        radiance = self.radiance(directions)[:, : self.channels]
        return radiance * np.float32(self.exposure)

    def lamps(self) -> tuple[Float32Array, Float32Array]:
        """Far fewer directions of the same flux, (n, 3), and their flux, (n, channels).

        Blocks of the grid become one lamp each, in the direction its flux points to;
        bright blocks are split first, so that a sun keeps its shape.
        """
        directions, solid_angle = latitude_longitude()
        flux = self.grid.reshape(-1, 3) * (solid_angle * self.exposure)[:, None]
        moment = flux.sum(axis=1, keepdims=True) * directions
        pointing, merged = _lamps(flux.reshape(*GRID, 3), moment.reshape(*GRID, 3))
        length = np.linalg.norm(pointing, axis=1, keepdims=True)
        lit = length[:, 0] > 0.0
        return (
            (pointing[lit] / length[lit]).astype(np.float32),
            merged[lit, : self.channels].astype(np.float32),
        )


def load(name: str) -> Environment:
    """Environment of a light of ours, or of the user's panorama file.

    Raises
    ------
    PreviewError
        When there is no such light, or when the file cannot be used.
    """
    path = Path(name)
    if path.suffix.lower() not in panorama.SUFFIXES:
        return _ours(name)
    try:
        changed_ns = path.stat().st_mtime_ns
    except OSError:
        changed_ns = 0
    return _photographed(path, changed_ns)


@lru_cache(maxsize=4)
def _photographed(path: Path, _changed_ns: int) -> Environment:
    radiance = panorama.radiance_of(panorama.load(path))
    return Environment(path.name, path.stem, radiance)


@cache
def _ours(name: str) -> Environment:
    module = import_module(find(name, lights, "light"))
    return Environment(name, module.LABEL, module.radiance)


@cache
def latitude_longitude() -> tuple[Float32Array, FloatArray]:
    """Directions of the grid, shape (h * w, 3), and their solid angles, (h * w,)."""
    rows, columns = GRID
    polar = (np.arange(rows) + 0.5) * np.pi / rows
    azimuth = (np.arange(columns) + 0.5) * 2.0 * np.pi / columns
    ring = np.cos(np.arange(rows) * np.pi / rows)
    band = ring - np.cos(np.arange(1, rows + 1) * np.pi / rows)
    x = np.outer(np.sin(polar), np.sin(azimuth))
    y = np.outer(np.cos(polar), np.ones(columns))
    z = np.outer(np.sin(polar), -np.cos(azimuth))
    directions = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32)
    return directions, np.repeat(band * 2.0 * np.pi / columns, columns)


def _lamps(flux: FloatArray, moment: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Moment and flux of blocks of 8, 4, 2 and 1 texels, both of shape (n, 3)."""
    most = MOST_OF_A_LAMP * flux.sum()
    rows, columns = GRID
    size = WIDEST_LAMP
    waiting = np.ones((rows // size, columns // size), dtype=np.bool_)
    taken = []
    while True:
        block = _merged(flux, size)
        keep = waiting & ((block.sum(axis=2) <= most) | (size == 1))
        taken.append((_merged(moment, size)[keep], block[keep]))
        waiting &= ~keep
        if size == 1:
            break
        size //= 2
        waiting = waiting.repeat(2, axis=0).repeat(2, axis=1)
    moments, fluxes = zip(*taken, strict=True)
    return np.concatenate(moments), np.concatenate(fluxes)


def _merged(values: FloatArray, size: int) -> FloatArray:
    rows, columns, channels = values.shape
    blocks = values.reshape(rows // size, size, columns // size, size, channels)
    merged: FloatArray = blocks.sum(axis=(1, 3))
    return merged
