"""The object turning once, drawn fast enough to be watched."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview import cpu, disc, store
from paintlink.preview.arrays import Float32Array
from paintlink.preview.backdrop import dither
from paintlink.preview.basis import TERMS, coefficients
from paintlink.preview.environment import load
from paintlink.preview.forms import form
from paintlink.preview.gloss import roughness_of
from paintlink.preview.scene import backdrop_codes
from paintlink.preview.surface import Surface
from paintlink.preview.view import View

PAINTED_SIZE = 384
FRAMES = range(2, 361)
SIZES = range(16, 1025)


@dataclass(frozen=True)
class Turntable:
    """A full turn.

    Parameters
    ----------
    frames
        Pictures in a turn, 2 to 360.
    size
        Width and height in pixels, 16 to 1024.
    """

    object: str = "car"
    light: str = "studio"
    size: int = 512
    frames: int = 72
    cache_dir: Path | None = None

    def __post_init__(self) -> None:
        for what, value, known in (
            ("frames", self.frames, FRAMES),
            ("pixels", self.size, SIZES),
        ):
            if value not in known:
                msg = f"a turntable has {known[0]} to {known[-1]} {what}, not {value}"
                raise PreviewError(msg)


class Frame(NamedTuple):
    """What one picture of the turn needs of the object.

    Parameters
    ----------
    corner, right, down
        Upper left texel of each covered pixel in the painted disc, and the place from
        there, shape (n,) each.
    """

    pixels: NDArray[np.intp]
    corner: NDArray[np.intp]
    right: Float32Array
    down: Float32Array
    lit: Float32Array
    cover: Float32Array
    behind: Float32Array
    dither: Float32Array
    plain: NDArray[np.uint8]


def turn(spec: ColorSpec, table: Turntable) -> Iterator[NDArray[np.uint8]]:
    """The pictures of a turn, shape (size, size, 3) each, drawn by numpy.

    The light and the viewer stand still; the object turns against the clock. Preparing
    a frame takes much longer than drawing it, and serves every further paint.
    """
    disc_of_paint = painted(spec, table)
    for number in range(table.frames):
        yield draw(frame(table, number), disc_of_paint)


def painted(spec: ColorSpec, table: Turntable) -> Float32Array:
    """Colour of the paint for every visible normal, shape (texels, 3)."""
    light, view = load(table.light), _view(table)
    base = store.base_table(light, table.cache_dir, view)
    coat = store.coat_table(light, roughness_of(spec.gloss), table.cache_dir, view)
    ink = coefficients([spec])[0].astype(np.float32)
    terms = base.reshape(*base.shape[:2], light.channels, TERMS)
    colours = np.einsum(
        "ijck,kc->ijc",
        np.broadcast_to(terms, (*terms.shape[:2], 3, TERMS)),
        ink,
        optimize=True,
    ).astype(np.float32)
    both: Float32Array = _enlarged(colours) + _enlarged(coat)
    return np.asfortranarray(both)


def draw(prepared: Frame, colours: Float32Array) -> NDArray[np.uint8]:
    """One picture, shape (size, size, 3)."""
    seen = _looked_up(prepared, colours)
    seen *= prepared.lit
    seen -= prepared.behind
    seen *= prepared.cover
    seen += prepared.behind
    cpu.into_gamut(seen)
    picture = prepared.plain.copy()
    codes = cpu.encoded(seen, prepared.dither)
    picture.reshape(-1, 3)[prepared.pixels] = codes.T
    return picture


@lru_cache(maxsize=FRAMES[-1])
def frame(table: Turntable, number: int) -> Frame:
    """One frame, prepared once."""
    shown = form(table.object, turn_deg=360.0 * number / table.frames)
    surface = shown.surface(table.size, slice(0, table.size), table.cache_dir)
    column, row = disc.position(_mean_normals(surface), PAINTED_SIZE)
    left, top = (
        np.clip(np.floor(place), 0, PAINTED_SIZE - 2).astype(np.intp)
        for place in (column, row)
    )
    grain = dither(slice(0, table.size), table.size)
    return Frame(
        pixels=surface.pixels,
        corner=top * PAINTED_SIZE + left,
        right=np.clip(column - left, 0.0, 1.0).astype(np.float32),
        down=np.clip(row - top, 0.0, 1.0).astype(np.float32),
        lit=surface.lit,
        cover=surface.cover,
        behind=surface.behind.ravel()[surface.pixels].astype(np.float32),
        dither=grain.ravel()[surface.pixels],
        plain=backdrop_codes(surface.behind, grain),
    )


def to_webp(frames: Sequence[NDArray[np.uint8]], *, seconds: float = 6.0) -> bytes:
    """An endless animated WebP of a turn; needs no player but a browser."""
    from io import BytesIO

    from PIL import Image

    first, *rest = [Image.fromarray(picture) for picture in frames]
    file = BytesIO()
    first.save(
        file,
        "WEBP",
        save_all=True,
        append_images=rest,
        duration=round(1000.0 * seconds / len(frames)),
        loop=0,
        quality=88,
        method=2,
    )
    return file.getvalue()


def _view(table: Turntable) -> View:
    return form(table.object, turn_deg=0.0).view


def _mean_normals(surface: Surface) -> Float32Array:
    total = np.add.reduceat(surface.normals, surface.first, axis=0)
    length = np.linalg.norm(total, axis=1, keepdims=True)
    mean: Float32Array = (total / np.maximum(length, 1e-9)).astype(np.float32)
    return mean


def _enlarged(table: Float32Array) -> Float32Array:
    normals = disc.normals(PAINTED_SIZE).reshape(-1, 3)
    larger = disc.look_up(table, normals)
    return np.ascontiguousarray(np.broadcast_to(larger, (len(larger), 3)))


def _looked_up(prepared: Frame, colours: Float32Array) -> Float32Array:
    """Painted disc at the covered pixels, shape (3, n)."""
    corner, right, down = prepared.corner, prepared.right, prepared.down
    planes = colours.T
    seen = np.empty((3, len(corner)), dtype=np.float32)
    for plane, into in zip(planes, seen, strict=True):
        upper, lower = plane[corner], plane[corner + PAINTED_SIZE]
        upper += (plane[corner + 1] - upper) * right
        lower += (plane[corner + PAINTED_SIZE + 1] - lower) * right
        np.add(upper, (lower - upper) * down, out=into)
    return seen
