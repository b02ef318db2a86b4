"""One object in one light, prepared so that any paint is only a sum away."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache, partial
from pathlib import Path
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from paintlink.color.display import encode_srgb, into_gamut
from paintlink.model import FloatArray
from paintlink.preview import forms, illustration, store
from paintlink.preview.arrays import Float32Array
from paintlink.preview.backdrop import dither
from paintlink.preview.environment import Environment
from paintlink.preview.gather import COARSE_NODES, gather
from paintlink.preview.illustration import PLAIN, Illustration
from paintlink.preview.layout import ALONE, Layout
from paintlink.preview.surface import Surface

BAND_PIXELS = 1 << 18

_preparing = Lock()


@dataclass(frozen=True)
class Scene:
    """What does not depend on the colours of the paints.

    Parameters
    ----------
    coats
        Roughness of each kind of clearcoat in the picture.
    """

    form: forms.Form
    light: Environment
    size: int
    coats: tuple[float, ...]
    cache_dir: Path | None
    layout: Layout = ALONE
    illustration: Illustration = PLAIN

    def bands(self) -> list[slice]:
        """Rows to draw at a time."""
        step = max(1, BAND_PIXELS // self.size)
        starts = range(0, self.size, step)
        return [slice(start, min(start + step, self.size)) for start in starts]


@dataclass(frozen=True, eq=False)
class Band:
    """The n covered pixels of some rows of a scene, and the rest of these rows.

    Parameters
    ----------
    light
        To be weighed with the inks and summed, shape (channels, terms, n).
    cover
        Share of each pixel the object covers, shape (n,).
    behind
        Linear grey of what it does not cover, shape (n,).
    dither
        Between -0.5 and 0.5 steps of 255, shape (n,).
    part
        Which paint each pixel shows, shape (n,).
    pixels
        Positions of the pixels in the rows, shape (n,).
    plain
        The rows without the object, encoded, shape (rows, columns, 3).
    grey
        The same as linear light, shape (rows, columns).
    """

    light: Float32Array
    cover: Float32Array
    behind: Float32Array
    dither: Float32Array
    part: NDArray[np.uint8]
    pixels: NDArray[np.intp]
    plain: NDArray[np.uint8]
    grey: Float32Array

    @property
    def channels(self) -> int:
        """1 in neutral light, else 3."""
        channels: int = self.light.shape[0]
        return channels

    @property
    def terms(self) -> int:
        """Number of planes each colour channel is a sum of."""
        terms: int = self.light.shape[1]
        return terms


def band(scene: Scene, rows: slice) -> Band:
    """Some rows of the scene; the latest few bands are kept for further paints."""
    with _preparing:
        return _band(scene, rows.start, rows.stop)


@lru_cache(maxsize=4)
def _band(scene: Scene, first: int, last: int) -> Band:
    surface = _surface(scene.form, scene.size, first, last, scene.cache_dir)
    alone = replace(scene, layout=ALONE)
    row, column = np.divmod(surface.pixels, scene.size)
    span = scene.form.span
    parts = scene.layout.parts(span, column, row + first, scene.size)
    grain = dither(slice(first, last), scene.size)
    return Band(
        light=_light(alone, first, last),
        cover=surface.cover * parts.share,
        behind=surface.behind.ravel()[surface.pixels].astype(np.float32),
        dither=grain.ravel()[surface.pixels],
        part=parts.number,
        pixels=surface.pixels,
        plain=backdrop_codes(surface.behind, grain),
        grey=surface.behind.astype(np.float32),
    )


@lru_cache(maxsize=4)
def _surface(
    form: forms.Form, size: int, first: int, last: int, cache_dir: Path | None
) -> Surface:
    return form.surface(size, slice(first, last), cache_dir)


@lru_cache(maxsize=4)
def _light(scene: Scene, first: int, last: int) -> Float32Array:
    """Light of every term averaged over each pixel, shape (channels, terms, n).

    Averaging the light is exact for every paint, because paints only weigh it.
    """
    surface = _surface(scene.form, scene.size, first, last, scene.cache_dir)
    layers, size = scene.illustration, scene.size
    wavy = illustration.with_orange_peel(surface, layers, size)
    coarse = surface.towards is not None
    table = partial(store.base_table, scene.light, scene.cache_dir, coarse=coarse)
    base = gather(surface, table)
    base *= illustration.grain(surface, layers, size)
    coats = [
        gather(
            wavy,
            partial(store.coat_table, scene.light, coat, scene.cache_dir),
            COARSE_NODES,
        )
        for coat in scene.coats
    ]
    channels, count = scene.light.channels, len(surface.pixels)
    light = np.concatenate(
        [
            part.reshape(channels, len(part) // channels, count)
            for part in (base, *coats)
        ],
        axis=1,
    )
    light *= surface.lit
    light.setflags(write=False)
    return light


def backdrop_codes(grey: FloatArray, grain: Float32Array) -> NDArray[np.uint8]:
    """The backdrop, shape (rows, columns, 3)."""
    shown = into_gamut(np.repeat(grey[..., np.newaxis], 3, axis=2))
    codes = 255.0 * encode_srgb(shown) + grain[..., np.newaxis]
    encoded: NDArray[np.uint8] = (codes + 0.5).astype(np.uint8)
    encoded.setflags(write=False)
    return encoded
