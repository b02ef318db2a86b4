"""Objects a sketch is painted on: smooth, closed formulas, seen from the front.

Places are picture units: x to the right and y up, both from -1 to 1, z towards the
viewer. Creases and hems, as the preview objects have them, would leave an artist a
few pixels at the flop.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, Protocol

import numpy as np

from paintlink.errors import InputError
from paintlink.model import FloatArray


class Surface(NamedTuple):
    """Points of an object, shape of the places asked for.

    Places outside the outline hold the nearest normal, or one that continues it.
    """

    normal: tuple[FloatArray, FloatArray, FloatArray]
    z: FloatArray


class Shape(Protocol):
    """An object; its light is placed about ``(0, centre_y, 0)``."""

    @property
    def centre_y(self) -> float:
        """Height of its middle in the picture."""
        ...

    @property
    def radius(self) -> float:
        """Half its width, the unit in which a point light is placed."""
        ...

    def surface(self, x: FloatArray, y: FloatArray) -> Surface:
        """Its points at places of the picture."""
        ...

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside the outline, negative outside."""
        ...


@dataclass(frozen=True, slots=True)
class Sphere:
    """A ball: every visible normal once."""

    centre_y: float = 0.06
    radius: float = 0.84

    def surface(self, x: FloatArray, y: FloatArray) -> Surface:
        """Its points at places of the picture."""
        across, up = x / self.radius, (y - self.centre_y) / self.radius
        level = np.sqrt(across * across + up * up)
        outside = np.maximum(level, 1.0)
        across, up = across / outside, up / outside
        towards = np.sqrt(np.maximum(1.0 - across * across - up * up, 0.0))
        return Surface((across, up, towards), self.radius * towards)

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside the outline, negative outside."""
        up = y - self.centre_y
        margin: FloatArray = self.radius - np.sqrt(x * x + up * up)
        return margin


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Half a cylinder lying across the picture."""

    centre_y: float = 0.06
    radius: float = 0.88
    bend: float = 0.72

    def surface(self, x: FloatArray, y: FloatArray) -> Surface:
        """Its points at places of the picture."""
        up = np.clip((y - self.centre_y) / self.bend, -1.0, 1.0)
        towards = np.sqrt(1.0 - up * up)
        return Surface((np.zeros_like(up), up, towards), self.bend * towards)

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside the outline, negative outside."""
        height = np.abs(y - self.centre_y)
        return np.minimum(self.radius - np.abs(x), self.bend - height)


@dataclass(frozen=True, slots=True)
class Panel:
    """A sheet bent both ways, as of a door: the face here, the flop along its sides.

    z = 0.9·cos(1.35·x)·cos(y − 0.1) on a scale of 1.15, within a superellipse.
    """

    centre_y: float = 0.06
    radius: float = 0.94
    scale: float = 1.15

    def surface(self, x: FloatArray, y: FloatArray) -> Surface:
        """Its points at places of the picture."""
        right, up = self.scale * x, self.scale * (y - self.centre_y)
        across, along = 1.35 * right, up - 0.1
        rise = 0.9 * np.cos(across)
        slope_x = 0.9 * 1.35 * np.sin(across) * np.cos(along)
        slope_y = rise * np.sin(along)
        z = rise * np.cos(along) / self.scale
        length = np.sqrt(slope_x * slope_x + slope_y * slope_y + 1.0)
        normal = (slope_x / length, slope_y / length, 1.0 / length)
        return Surface(normal, z)

    def margin(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Distance inside |x/1.08|⁶ + |y/0.8|⁶ = 1, to first order."""
        right, up = self.scale * x, self.scale * (y - self.centre_y)
        square_x, square_y = (right / 1.08) ** 2, (up / 0.8) ** 2
        level = square_x**3 + square_y**3
        step_x = 6.0 * square_x * square_x * right / 1.08**2
        step_y = 6.0 * square_y * square_y * up / 0.8**2
        steepness = np.maximum(np.sqrt(step_x * step_x + step_y * step_y), 1e-6)
        margin: FloatArray = (1.0 - level) / (steepness * self.scale)
        return margin


SHAPES: Mapping[str, Shape] = MappingProxyType({
    "cylinder": Cylinder(),
    "panel": Panel(),
    "sphere": Sphere(),
})


def require_shape(name: str) -> Shape:
    """The object of a name.

    Raises
    ------
    InputError
        When there is none of that name.
    """
    if name not in SHAPES:
        msg = f"no sketch object {name!r}; there are {', '.join(SHAPES)}"
        raise InputError(msg)
    return SHAPES[name]
