"""The OpenGL objects behind `gl.draw`, used from their owner's thread only."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.preview import cpu
from paintlink.preview.arrays import Float32Array
from paintlink.preview.basis import TERMS
from paintlink.preview.probe import require_context
from paintlink.preview.scene import Band
from paintlink.preview.shader import FRAGMENT, HEADER, VERTEX, Shape

GLSL = 330
KEPT = 4
TRIAL = 256
COLUMNS = 512
TOLERANCE = 1


class Painter:
    """A context, its programs, and the textures of the latest bands.

    Raises
    ------
    PreviewError
        When no context can be had, or when it draws other pictures than numpy does.
    """

    def __init__(self) -> None:
        require_context()
        import moderngl

        egl: dict[str, Any] = {"backend": "egl"}
        opened: Any = moderngl.create_context(require=GLSL, standalone=True, **egl)
        # without it moderngl keeps the memory of what was released
        opened.gc_mode = "auto"
        self._context = opened
        self.renderer = _renderer(opened.info)
        self._triangles: dict[Shape, Any] = {}
        self._textures = _Shelf(self._upload)
        self._targets = _Shelf(self._target)
        self._require_agreement()

    def draw(self, band: Band, inks: Float32Array) -> NDArray[np.uint8]:
        """Encoded pixels of a band as `cpu.draw` gives them, shape (4, n)."""
        count = len(band.pixels)
        rows = -(-count // COLUMNS)
        if not rows:
            return np.empty((4, 0), dtype=np.uint8)
        layers = _used(_layers(inks.transpose(1, 0, 2)))
        target = self._targets.take((COLUMNS, rows))
        self._textures.take(band).use(0)
        triangle = self._triangle(_shape(band, layers))
        triangle.program["inks"].write(layers.transpose(2, 0, 3, 1).tobytes())
        target.use()
        triangle.render(vertices=3)
        # llvmpipe draws on all processors for this, but not for a read that waits.
        self._context.finish()
        pixels = target.read(components=4, alignment=1)
        return np.frombuffer(pixels, np.uint8).reshape(-1, 4)[:count].T

    def _triangle(self, shape: Shape) -> Any:
        """What covers the target, with the program of this shape."""
        if shape not in self._triangles:
            fragment = HEADER.format(**shape._asdict()) + FRAGMENT
            program = self._context.program(
                vertex_shader=VERTEX, fragment_shader=fragment
            )
            self._triangles[shape] = self._context.vertex_array(program, [])
        return self._triangles[shape]

    def _upload(self, band: Band) -> Any:
        frame = np.stack([band.cover, band.behind, band.dither, band.part])
        light = [_layers(channel) for channel in band.light]
        layers = np.concatenate([*light, frame[np.newaxis]])
        rows = -(-len(band.pixels) // COLUMNS)
        texels = np.zeros((len(layers), rows * COLUMNS, 4), dtype=np.float32)
        texels[:, : len(band.pixels)] = layers.transpose(0, 2, 1)
        size = (COLUMNS, rows, len(texels))
        return self._context.texture_array(size, 4, texels, dtype="f4")

    def _target(self, size: tuple[int, int]) -> Any:
        return self._context.framebuffer(self._context.renderbuffer(size, 4))

    def _require_agreement(self) -> None:
        """Draw random numbers both ways; also makes the driver compile the program."""
        band, inks = _trial()
        difference = self.draw(band, inks) - cpu.draw(band, inks).astype(np.int16)
        if np.abs(difference).max() > TOLERANCE:
            msg = f"{self.renderer} draws other colours than it should"
            raise PreviewError(msg)


class _Shelf:
    """The latest few OpenGL objects, made when first asked for, released when old."""

    def __init__(self, make: Callable[[Any], Any]) -> None:
        self._make = make
        self._kept: OrderedDict[Hashable, Any] = OrderedDict()

    def take(self, key: Hashable) -> Any:
        if key not in self._kept:
            self._kept[key] = self._make(key)
        self._kept.move_to_end(key)
        if len(self._kept) > KEPT:
            self._kept.popitem(last=False)[1].release()
        return self._kept[key]


def _renderer(info: dict[str, Any]) -> str:
    """Name and version of what draws, in its own words."""
    return f"{info['GL_RENDERER']}, OpenGL {info['GL_VERSION']}"


def _layers(terms: Float32Array) -> Float32Array:
    """Terms in layers of four, the last filled up with zeros: (layers, 4, ...).

    The coats come first, so that the term for −15, which few paints have, is last.
    """
    turned = np.roll(terms, len(terms) - TERMS, axis=0)
    filler = np.zeros((-len(terms) % 4, *terms.shape[1:]), dtype=terms.dtype)
    return np.concatenate([turned, filler]).reshape(-1, 4, *terms.shape[1:])


def _used(layers: Float32Array) -> Float32Array:
    """The layers without those at the end that add nothing; at least one."""
    adding = np.flatnonzero(layers.any(axis=(1, 2, 3)))
    return layers[: adding[-1] + 1 if len(adding) else 1]


def _shape(band: Band, used: Float32Array) -> Shape:
    layers, _, paints, _ = used.shape
    return Shape(band.channels, -(-band.terms // 4), layers, paints)


def _trial() -> tuple[Band, Float32Array]:
    """A band of two paints with values from far below to far above what is shown."""
    random = np.random.default_rng(0)
    light, frame = np.split(random.random((8, TRIAL), dtype=np.float32), [5])
    band = Band(
        light=light[np.newaxis],
        cover=frame[0],
        behind=frame[1],
        dither=frame[2] - np.float32(0.5),
        part=np.arange(TRIAL, dtype=np.uint8) % 2,
        pixels=np.arange(TRIAL),
        plain=np.zeros((1, TRIAL, 3), dtype=np.uint8),
        grey=np.zeros((1, TRIAL), dtype=np.float32),
    )
    return band, random.uniform(-0.5, 1.5, (2, 5, 3)).astype(np.float32)
