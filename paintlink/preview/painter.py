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
from paintlink.preview.probe import require_context
from paintlink.preview.scene import Band
from paintlink.preview.shader import FRAGMENT, MAX_LAYERS, VERTEX
from paintlink.preview.strips import MOST, Strips

GLSL = 330
KEPT = 4
INKS_BYTES = MOST * MAX_LAYERS * 3 * 4 * 4
TRIAL_SIZE = 16
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

    def draw(self, band: Band, strips: Strips) -> NDArray[np.uint8]:
        """Encoded picture of a band, shape (rows, columns, 3)."""
        _, rows, columns = band.planes.shape
        target = self._targets.take((columns, rows))
        self._textures.take(band).use(0)
        self._program["channels"] = band.channels
        self._set_strips(strips)
        target.use()
        self._triangle.render(vertices=3)
        pixels = target.read(components=3, alignment=1)
        return np.frombuffer(pixels, np.uint8).reshape(rows, columns, 3)

    def _set_strips(self, strips: Strips) -> None:
        layers = _fours(strips.inks.transpose(1, 0, 2))
        inks = layers.transpose(2, 0, 3, 1).tobytes()
        nowhere = (2 * strips.edges[-1],) * (MOST - len(strips.inks))
        self._program["inks"].write(inks.ljust(INKS_BYTES, b"\0"))
        self._program["edges"] = (*strips.edges[1:-1], *nowhere)
        self._program["half_seam"] = strips.half_seam
        self._program["layers"] = len(layers)

    def _upload(self, band: Band) -> Any:
        _, rows, columns = band.planes.shape
        light = band.planes[:-3].reshape(band.channels, band.terms, rows, columns)
        layers = np.concatenate([_fours(part) for part in (*light, band.planes[-3:])])
        texels = np.ascontiguousarray(layers.transpose(0, 2, 3, 1))
        size = (columns, rows, len(texels))
        return self._context.texture_array(size, 4, texels, dtype="f4")

    def _target(self, size: tuple[int, int]) -> Any:
        return self._context.framebuffer(self._context.renderbuffer(size, 4))

    def _require_agreement(self) -> None:
        """Draw random numbers both ways; also makes the driver compile the program."""
        band, strips = _trial()
        difference = self.draw(band, strips) - cpu.draw(band, strips).astype(np.int16)
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


def _trial() -> tuple[Band, Strips]:
    """A band of two strips with values from far below to far above what is shown."""
    random = np.random.default_rng(0)
    planes = random.random((8, TRIAL_SIZE, TRIAL_SIZE), dtype=np.float32)
    planes[-1] -= 0.5
    inks = random.uniform(-0.5, 1.5, (2, 5, 3)).astype(np.float32)
    return Band(planes, channels=1), Strips(inks, (0, TRIAL_SIZE // 2, TRIAL_SIZE))
