"""One object in one light, prepared so that any paint is only a sum away."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Protocol, cast

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview import disc, environment, objects, store
from paintlink.preview.arrays import Float32Array
from paintlink.preview.backdrop import Ellipse, backdrop, dither
from paintlink.preview.names import find

BAND_PIXELS = 1 << 17
SAMPLES_ACROSS = 1024

_preparing = Lock()


class Shape(Protocol):
    """What a file in ``objects/`` declares; see the docstring of that folder."""

    LABEL: str
    SPAN: tuple[float, float]
    SHADOWS: tuple[Ellipse, ...]

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside the outline, negative outside, shape of ``x``."""
        ...

    def normals(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Unit normals of points in or just outside the outline, shape (n, 3)."""
        ...


@dataclass(frozen=True)
class Scene:
    """What does not depend on the colours of the paints.

    Parameters
    ----------
    coats
        Roughness of each kind of clearcoat in the picture.
    """

    object: str
    light: str
    size: int
    coats: tuple[float, ...]
    cache_dir: Path | None

    @property
    def channels(self) -> int:
        """1 in neutral light, else 3."""
        return environment.load(self.light).channels

    def bands(self) -> list[slice]:
        """Rows to draw at a time."""
        step = max(1, BAND_PIXELS // self.size)
        starts = range(0, self.size, step)
        return [slice(start, min(start + step, self.size)) for start in starts]


@dataclass(frozen=True, eq=False)
class Band:
    """Some rows of a scene as planes, shape (planes, rows, columns).

    First ``channels * terms`` planes of light, to be weighed with the inks and summed;
    then the share of each pixel the object covers, the backdrop, and the dither.
    """

    planes: Float32Array
    channels: int

    @property
    def terms(self) -> int:
        """Number of planes each colour channel is a sum of."""
        return (len(self.planes) - 3) // self.channels


def load_shape(name: str) -> Shape:
    """The object file ``name``."""
    return cast(Shape, import_module(find(name, objects, "object")))


def band(scene: Scene, rows: slice) -> Band:
    """Some rows of the scene; the latest few bands are kept for further paints."""
    with _preparing:
        return _band(scene, rows.start, rows.stop)


@lru_cache(maxsize=4)
def _band(scene: Scene, first: int, last: int) -> Band:
    shape = load_shape(scene.object)
    x, y = _pixel_centres(scene.size, slice(first, last))
    cover = np.clip(0.5 + shape.margin(x, y) * (scene.size / 2.0), 0.0, 1.0)
    covered = cover > 0.0
    light = _light_planes(scene, shape, x[covered], y[covered])
    planes = np.zeros((len(light) + 3, *x.shape), dtype=np.float32)
    planes[:-3, covered] = light
    planes[-3] = cover
    planes[-2] = backdrop(x, y, shape.SHADOWS)
    planes[-1] = dither(slice(first, last), scene.size)
    planes.setflags(write=False)
    return Band(planes, scene.channels)


def _pixel_centres(size: int, rows: slice) -> tuple[FloatArray, FloatArray]:
    column = (2.0 * np.arange(size) + 1.0) / size - 1.0
    row = 1.0 - (2.0 * np.arange(rows.start, rows.stop) + 1.0) / size
    x, y = np.meshgrid(column, row)
    return x, y


def _light_planes(
    scene: Scene, shape: Shape, x: FloatArray, y: FloatArray
) -> Float32Array:
    """Light of every term averaged over each pixel, shape (channels * terms, n).

    Averaging the light is exact for every paint, because paints only weigh it.
    """
    offsets = _sample_offsets(scene.size)
    normals = [
        shape.normals(x + right, y + up).astype(np.float32) for right, up in offsets
    ]
    terms = [_averaged(table, normals, scene.channels) for table in _tables(scene)]
    return np.concatenate(np.concatenate(terms, axis=1))


def _tables(scene: Scene) -> list[Float32Array]:
    light, folder = scene.light, scene.cache_dir
    coats = [store.coat_table(light, coat, folder) for coat in scene.coats]
    return [store.base_table(light, folder), *coats]


def _averaged(
    table: Float32Array, normals: list[Float32Array], channels: int
) -> Float32Array:
    """Mean of the table over the samples of n pixels, shape (channels, terms, n)."""
    total = disc.look_up(table, normals[0])
    for sample in normals[1:]:
        total += disc.look_up(table, sample)
    total /= np.float32(len(normals))
    return total.T.reshape(channels, table.shape[2] // channels, len(total))


def _sample_offsets(size: int) -> list[tuple[float, float]]:
    """Places within a pixel to look at, relative to its centre, in picture units."""
    across = int(np.clip(round(SAMPLES_ACROSS / size), 1, 4))
    steps = ((np.arange(across) + 0.5) / across - 0.5) * 2.0 / size
    return [(right, up) for right in steps for up in steps]
