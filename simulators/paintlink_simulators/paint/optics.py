"""Light through the clearcoat: refraction, Fresnel losses, and the flake it meets.

Every angle of a function's name or field says whether it lies in air or in the coat.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from paintlink.errors import InputError
from paintlink.model import FloatArray

COAT_INDEX = 1.5
"""Refractive index of clearcoat and binder, taken as one medium."""


class Rays(NamedTuple):
    """The way of light in the coat at each geometry, shape (g,) each.

    ``tilt_rad`` is the tilt of the flakes that mirror the lamp into the detector,
    ``incidence_rad`` the angle of incidence on them, ``cos_in`` and ``cos_out`` belong
    to the two refracted rays, ``transmission`` is what both surface crossings let
    through.
    """

    tilt_rad: FloatArray
    incidence_rad: FloatArray
    cos_in: FloatArray
    cos_out: FloatArray
    transmission: FloatArray


def rays(aspecular_deg: ArrayLike, illumination_deg: ArrayLike = 45.0) -> Rays:
    """The way of light in the coat for in-plane geometries in air.

    Parameters
    ----------
    aspecular_deg
        Positive from the mirror direction towards the normal and the lamp, so the view
        lies at illumination minus aspecular. One or more angles.
    illumination_deg
        From the normal; one for all geometries or one each.

    Raises
    ------
    InputError
        When lamp or view would be at or below the surface.

    References
    ----------
    Germer and Marx, "Ray model of light scattering by flake pigments", Appl. Opt. 43
    (2004) 1266: both rays are refracted, the flake is tilted to their half vector.
    """
    lamp, aspecular = np.broadcast_arrays(
        np.atleast_1d(np.asarray(illumination_deg, dtype=np.float64)),
        np.atleast_1d(np.asarray(aspecular_deg, dtype=np.float64)),
    )
    view = lamp - aspecular
    _check(lamp, "illumination")
    _check(view, "view")
    inward, outward = _refracted(lamp), _refracted(view)
    return Rays(
        tilt_rad=(inward - outward) / 2.0,
        incidence_rad=np.abs(inward + outward) / 2.0,
        cos_in=np.cos(inward),
        cos_out=np.cos(outward),
        transmission=transmission(lamp) * transmission(view),
    )


def transmission(angle_deg: ArrayLike) -> FloatArray:
    """Share of unpolarised light that crosses the coat's surface, angle in air.

    References
    ----------
    Fresnel's equations for air to ``COAT_INDEX``.
    """
    angle = np.radians(np.asarray(angle_deg, dtype=np.float64))
    outside = np.cos(angle)
    inside = np.cos(_refracted(angle_deg))
    perpendicular = (outside - COAT_INDEX * inside) / (outside + COAT_INDEX * inside)
    parallel = (COAT_INDEX * outside - inside) / (COAT_INDEX * outside + inside)
    passed: FloatArray = 1.0 - (perpendicular**2 + parallel**2) / 2.0
    return passed


def _refracted(angle_deg: ArrayLike) -> FloatArray:
    """Angle in the coat in radians, by Snell's law; keeps the sign."""
    sine = np.sin(np.radians(np.asarray(angle_deg, dtype=np.float64)))
    angle: FloatArray = np.arcsin(sine / COAT_INDEX)
    return angle


def _check(angle_deg: FloatArray, what: str) -> None:
    outside = angle_deg[~(np.abs(angle_deg) < 90.0)]
    if outside.size:
        msg = (
            f"{what} at {outside[0]:g} degrees from the normal does not reach a panel: "
            "it must lie within 90 degrees of it"
        )
        raise InputError(msg)
