"""Pictures drawn with OpenGL, by the one thread that owns the context."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from paintlink.preview.arrays import Float32Array
from paintlink.preview.owner import Owner
from paintlink.preview.painter import Painter
from paintlink.preview.scene import Band

TIMEOUT_S = 60.0

Answer = TypeVar("Answer")

_owners: list[Owner[Painter]] = []
_opening = threading.Lock()


def prepare() -> None:
    """Begin to open the context, without waiting for it."""
    with _opening:
        if not _owners:
            _owners.append(Owner(Painter))


def draw(band: Band, inks: Float32Array) -> NDArray[np.uint8]:
    """Encoded pixels of a band, shape (4, n); see `cpu.draw`.

    Raises
    ------
    PreviewError
        When there is no OpenGL, or it fails.
    """
    return _lend(lambda painter: painter.draw(band, inks))


def renderer() -> str:
    """Name and version of what draws; errors are those of `draw`."""
    return _lend(lambda painter: painter.renderer)


def _lend(job: Callable[[Painter], Answer]) -> Answer:
    prepare()
    return _owners[0].lend(job, timeout_s=TIMEOUT_S)
