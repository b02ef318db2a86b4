"""What a renderer gives back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from paintlink.model import ColorSpec

Backend = Literal["auto", "gl", "cpu"]

WARNING = "not for visual matching"


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A drawn paint, or several side by side, with how it came about.

    Parameters
    ----------
    rgb
        Encoded sRGB, shape (height, width, 3), top row first; read-only.
    backend
        What drew it: ``gl`` or ``cpu``.
    reason
        Which renderer that is, or why it was not OpenGL.
    notes
        What had to be assumed, in words for people.
    """

    rgb: NDArray[np.uint8]
    backend: Literal["gl", "cpu"]
    reason: str
    object: str
    light: str
    specs: tuple[ColorSpec, ...]
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.rgb.setflags(write=False)
