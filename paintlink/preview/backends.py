"""Who draws: OpenGL where it can be had, numpy everywhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.preview import cpu, gl
from paintlink.preview.picture import Backend
from paintlink.preview.scene import Band, Scene, band
from paintlink.preview.strips import Strips

Draw = Callable[[Band, Strips], NDArray[np.uint8]]


class Drawn(NamedTuple):
    """Encoded pixels, shape (size, size, 3), who drew them, and why."""

    rgb: NDArray[np.uint8]
    backend: Literal["gl", "cpu"]
    reason: str


def draw(scene: Scene, strips: Strips, backend: Backend) -> Drawn:
    """The whole scene in the given strips.

    Raises
    ------
    PreviewError
        When ``backend`` is ``gl`` and OpenGL is not to be had; never for the others.
    """
    if backend == "cpu":
        return Drawn(_whole(scene, strips, cpu.draw), "cpu", "numpy, as asked for")
    gl.prepare()
    try:
        return Drawn(_whole(scene, strips, gl.draw), "gl", gl.renderer())
    except PreviewError as trouble:
        if backend == "gl":
            msg = f"{trouble}: install a working driver, or let numpy draw (cpu, auto)"
            raise PreviewError(msg) from trouble
        return Drawn(_whole(scene, strips, cpu.draw), "cpu", f"numpy: {trouble}")


def _whole(scene: Scene, strips: Strips, draw_band: Draw) -> NDArray[np.uint8]:
    drawn = [draw_band(band(scene, rows), strips) for rows in scene.bands()]
    return np.concatenate(drawn)
