"""What a sketch shows, before any paint: an object, a light, a size."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from paintlink.errors import InputError
from paintlink.sketch.shapes import require_shape

LightKind = Literal["directional", "point"]

SIZES = range(256, 4097)
MOST_POLAR_DEG = 85.0
NEAREST = 2.0


@dataclass(frozen=True, slots=True)
class Light:
    """One lamp and nothing else: no surroundings, no falloff with the distance.

    Parameters
    ----------
    kind
        ``directional``: parallel rays; ``point``: a lamp near the object.
    polar_deg
        Angle between the view and the lamp, seen from the middle of the object.
    azimuth_deg
        Where the lamp is, seen by the viewer: 0 right, 90 above, 135 upper left.
    distance
        Of a point light from the middle of the object, in half widths of the object.
    """

    polar_deg: float
    azimuth_deg: float
    kind: LightKind = "directional"
    distance: float = 4.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.polar_deg <= MOST_POLAR_DEG:
            msg = (
                f"the light may stand 0 to {MOST_POLAR_DEG:g} degrees off the view, "
                f"not {self.polar_deg:g}"
            )
            raise InputError(msg)
        if not math.isfinite(self.azimuth_deg):
            msg = f"the azimuth of the light is an angle, not {self.azimuth_deg}"
            raise InputError(msg)
        if not NEAREST <= self.distance <= 1e6:
            msg = (
                f"a point light stands at least {NEAREST:g} half widths from the "
                f"middle of the object, not {self.distance:g}"
            )
            raise InputError(msg)

    @property
    def direction(self) -> tuple[float, float, float]:
        """Unit vector from the middle of the object to the lamp."""
        polar, azimuth = math.radians(self.polar_deg), math.radians(self.azimuth_deg)
        level = math.sin(polar)
        return level * math.cos(azimuth), level * math.sin(azimuth), math.cos(polar)


USUAL_LIGHTS: Mapping[str, Light] = MappingProxyType({
    "cylinder": Light(30.0, 90.0),
    "panel": Light(38.0, 135.0),
    "sphere": Light(30.0, 135.0),
})
"""A light for each object that shows face and flop and flatters the form."""


def light_for(
    name: str,
    direction_deg: tuple[float, float] | None = None,
    distance: float | None = None,
) -> Light:
    """A light for an object: where it is asked for, else where it suits the object.

    Parameters
    ----------
    direction_deg
        Polar angle and azimuth.
    distance
        Of a point light; None for parallel rays.
    """
    require_shape(name)
    usual = USUAL_LIGHTS[name]
    polar, azimuth = direction_deg or (usual.polar_deg, usual.azimuth_deg)
    if distance is None:
        return Light(polar, azimuth)
    return Light(polar, azimuth, "point", distance)


@dataclass(frozen=True, slots=True)
class Pose:
    """An object in a light, as a square picture of ``size`` pixels."""

    object: str
    light: Light
    size: int

    def __post_init__(self) -> None:
        require_shape(self.object)
        if self.size not in SIZES:
            msg = f"a sketch is {SIZES[0]} to {SIZES[-1]} pixels wide, not {self.size}"
            raise InputError(msg)
