"""A painted panel as every instrument sees it: reflectance factors by angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from paintlink.errors import ReadingError
from paintlink.model import FloatArray, Texture
from paintlink_simulators.paint.reconstruction import smoothest_factors
from paintlink_simulators.paint.wavelengths import WAVELENGTHS_NM

MAX_FACTOR = 15.0
"""More than twice the brightest flake paint."""


@dataclass(frozen=True, slots=True, eq=False)
class Panel:
    """The true reflectance factors of a painted panel, lit from 45 degrees.

    Parameters
    ----------
    aspecular_deg
        Ascending aspecular angles, shape (m,).
    factors
        Shape (m, 31), 400 to 700 nm in steps of 10 nm; 1.0 = 100 %; effect paints
        exceed it.
    gloss_gu
        At 60 degrees, where it is known.
    texture
        Invented texture numbers, see `texture.texture`.
    """

    aspecular_deg: FloatArray
    factors: FloatArray
    name: str = ""
    gloss_gu: float | None = None
    texture: tuple[Texture, ...] = ()

    def __post_init__(self) -> None:
        angles = _readonly(self.aspecular_deg)
        factors = _readonly(self.factors)
        if not angles.size or (np.diff(angles) <= 0.0).any():
            msg = f"the angles of panel {self.name!r} must ascend, got {angles}"
            raise ReadingError(msg)
        if factors.shape != (angles.size, WAVELENGTHS_NM.size):
            msg = (
                f"panel {self.name!r} needs {WAVELENGTHS_NM.size} reflectance factors "
                f"at each of {angles.size} angles, got shape {factors.shape}"
            )
            raise ReadingError(msg)
        if not ((factors >= 0.0) & (factors <= MAX_FACTOR)).all():
            msg = (
                f"reflectance factors of panel {self.name!r} must lie between 0 and "
                f"{MAX_FACTOR:g}, got {factors.min():g} to {factors.max():g}"
            )
            raise ReadingError(msg)
        object.__setattr__(self, "aspecular_deg", angles)
        object.__setattr__(self, "factors", factors)

    @property
    def wavelengths_nm(self) -> FloatArray:
        """400 to 700 nm in steps of 10 nm, shape (31,)."""
        return WAVELENGTHS_NM

    def factors_at(self, aspecular_deg: ArrayLike) -> FloatArray:
        """The reflectance factors at one or more angles, shape (..., 31).

        Linear between the angles of the panel, held beyond the outer ones.
        """
        angles = np.asarray(aspecular_deg, dtype=np.float64)
        if self.aspecular_deg.size == 1:
            return np.broadcast_to(
                self.factors[0], (*angles.shape, WAVELENGTHS_NM.size)
            )
        held = np.clip(angles, self.aspecular_deg[0], self.aspecular_deg[-1])
        below = np.searchsorted(self.aspecular_deg[1:-1], held, side="right")
        start, end = self.aspecular_deg[below], self.aspecular_deg[below + 1]
        share = ((held - start) / (end - start))[..., None]
        return (1.0 - share) * self.factors[below] + share * self.factors[below + 1]


def panel_from_lab(aspecular_deg: ArrayLike, lab: ArrayLike, name: str = "") -> Panel:
    """A panel with smooth spectra that have exactly the given Lab, D65/10.

    Parameters
    ----------
    lab
        One row per angle, shape (m, 3).

    Raises
    ------
    ReadingError
        When no positive spectrum has one of the colours.
    """
    rows = [smoothest_factors(colour) for colour in np.asarray(lab, dtype=np.float64)]
    return Panel(np.asarray(aspecular_deg, dtype=np.float64), np.array(rows), name)


def _readonly(values: FloatArray) -> FloatArray:
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array
