"""Who draws: OpenGL where it is faster, numpy everywhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.preview import cpu, gl
from paintlink.preview.arrays import Float32Array
from paintlink.preview.picture import Backend
from paintlink.preview.scene import Band, Scene, band

SOFTWARE = ("llvmpipe", "softpipe", "swrast", "software")
"""In the names of drivers that compute on the processor, where numpy is faster."""

Draw = Callable[[Band, Float32Array], NDArray[np.uint8]]


class Drawn(NamedTuple):
    """A picture, who drew it, and why.

    Parameters
    ----------
    rgb
        Encoded, shape (size, size, 3).
    flags
        How many covered pixels there are of each sum of `cpu.TOO_CHROMATIC` and
        `cpu.TOO_BRIGHT`, shape (4,).
    """

    rgb: NDArray[np.uint8]
    flags: NDArray[np.intp]
    backend: Literal["gl", "cpu"]
    reason: str


def draw(scene: Scene, inks: Float32Array, backend: Backend) -> Drawn:
    """The whole scene in the given paints; ``inks`` as in `cpu.draw`.

    Raises
    ------
    PreviewError
        When ``backend`` is ``gl`` and OpenGL is not to be had; never for the others.
    """
    if backend == "cpu":
        return Drawn(*_whole(scene, inks, cpu.draw), "cpu", "numpy, as asked for")
    gl.prepare()
    band(scene, scene.bands()[0])  # while the context opens
    try:
        renderer = gl.renderer()
        if backend == "auto" and any(name in renderer.lower() for name in SOFTWARE):
            reason = f"numpy: faster than {renderer}"
            return Drawn(*_whole(scene, inks, cpu.draw), "cpu", reason)
        return Drawn(*_whole(scene, inks, gl.draw), "gl", renderer)
    except PreviewError as trouble:
        if backend == "gl":
            msg = f"{trouble}: install a working driver, or let numpy draw (cpu, auto)"
            raise PreviewError(msg) from trouble
        return Drawn(*_whole(scene, inks, cpu.draw), "cpu", f"numpy: {trouble}")


def _whole(
    scene: Scene, inks: Float32Array, draw_band: Draw
) -> tuple[NDArray[np.uint8], NDArray[np.intp]]:
    picture, flags = [], np.zeros(4, dtype=np.intp)
    for rows in scene.bands():
        prepared = band(scene, rows)
        *codes, shown = draw_band(prepared, inks)
        drawn = prepared.plain.copy()
        for plane, code in zip(drawn.reshape(-1, 3).T, codes, strict=True):
            plane[prepared.pixels] = code
        flags += np.bincount(shown, minlength=4)
        picture.append(drawn)
    return picture[0] if len(picture) == 1 else np.concatenate(picture), flags


def linear(scene: Scene, inks: Float32Array) -> Float32Array:
    """Light of the whole scene before it is brought into sRGB, (size, size, 3)."""
    rows = []
    for some in scene.bands():
        prepared = band(scene, some)
        rows.append(np.repeat(prepared.grey[..., np.newaxis], 3, axis=2))
        places = rows[-1].reshape(-1, 3)
        seen = cpu.radiance(prepared, inks, slice(None))
        places[prepared.pixels] = seen.T
    return np.concatenate(rows)
