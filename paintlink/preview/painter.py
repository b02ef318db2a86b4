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
from paintlink.preview.layout import MOST
from paintlink.preview.probe import require_context
from paintlink.preview.scene import Band
from paintlink.preview.shader import FRAGMENT, MAX_LAYERS, VERTEX

GLSL = 330
KEPT = 4
INKS_BYTES = MOST * MAX_LAYERS * 3 * 4 * 4
TRIAL = 256
COLUMNS = 512
TOLERANCE = 1


class Painter:
    """A context, its program, and the textures of the latest bands.

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
        self._program = opened.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        self._triangle = opened.vertex_array(self._program, [])
        self._textures = _Shelf(self._upload)
        self._targets = _Shelf(self._target)
        self._require_agreement()

    @property
    def renderer(self) -> str:
        """Name and version of what draws, in its own words."""
        info = self._context.info
        return f"{info['GL_RENDERER']}, OpenGL {info['GL_VERSION']}"

    def draw(self, band: Band, inks: Float32Array) -> NDArray[np.uint8]:
        """Encoded pixels of a band as `cpu.draw` gives them, shape (n, 4)."""
        rows = -(-len(band.pixels) // COLUMNS)
        if not rows:
            return np.empty((0, 4), dtype=np.uint8)
        target = self._targets.take((COLUMNS, rows))
        self._textures.take(band).use(0)
        self._program["channels"] = band.channels
        self._set_inks(inks)
        target.use()
        self._triangle.render(vertices=3)
        pixels = target.read(components=4, alignment=1)
        return np.frombuffer(pixels, np.uint8).reshape(-1, 4)[: len(band.pixels)]

    def _set_inks(self, inks: Float32Array) -> None:
        layers = _fours(inks.transpose(1, 0, 2))
        data = layers.transpose(2, 0, 3, 1).tobytes()
        self._program["inks"].write(data.ljust(INKS_BYTES, b"\0"))
        self._program["layers"] = len(layers)

    def _upload(self, band: Band) -> Any:
        frame = np.stack([band.cover, band.behind, band.dither, band.part])
        layers = np.concatenate([_fours(part) for part in (*band.light, frame)])
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


def _fours(planes: Float32Array) -> Float32Array:
    """Planes in layers of four, the last one filled up with zeros: (layers, 4, ...)."""
    missing = -len(planes) % 4
    filler = np.zeros((missing, *planes.shape[1:]), dtype=planes.dtype)
    return np.concatenate([planes, filler]).reshape(-1, 4, *planes.shape[1:])


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
