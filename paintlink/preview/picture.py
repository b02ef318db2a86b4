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
    setting
        Object and light in words for people.
    flags
        How many covered pixels there are of each sum of `cpu.TOO_CHROMATIC` and
        `cpu.TOO_BRIGHT`.
    notes
        What had to be assumed, in words for people.
    """

    rgb: NDArray[np.uint8]
    backend: Literal["gl", "cpu"]
    reason: str
    object: str
    light: str
    specs: tuple[ColorSpec, ...]
    setting: str = ""
    flags: tuple[int, ...] = (0, 0, 0, 0)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.rgb.setflags(write=False)

    @property
    def too_chromatic(self) -> float:
        """Share of the object that sRGB has no chroma for, 0 to 1."""
        return (self.flags[1] + self.flags[3]) / max(sum(self.flags), 1)

    @property
    def too_bright(self) -> float:
        """Share of the object brighter than the screen, shown darker, 0 to 1."""
        return (self.flags[2] + self.flags[3]) / max(sum(self.flags), 1)
