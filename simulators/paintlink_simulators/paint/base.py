"""Light that goes astray in the film: Kubelka-Munk under a clearcoat."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators.paint.films import Response, response
from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.optics import COAT_INDEX, transmission
from paintlink_simulators.paint.pigments import PIGMENTS

INTERNAL_REFLECTION = 1.0 - (1.0 - 0.0918) / COAT_INDEX**2
"""Share of diffuse light that the surface of the coat sends back inside; 0.0918 is the
external diffuse Fresnel reflectance of n = 1.5."""

TYPICAL_INCIDENCE_RAD = np.radians(20.0)
"""At which flakes act on light that is on no particular way."""

LOSS_TO_DIFFUSE = 0.8
"""How much of the light that a flake swallows the diffuse light loses: an assumption,
as the next one."""

TINT_OF_DIFFUSE = 0.12
"""How much of an interference flake's own colour ends as diffuse light."""


class FlakeSums(NamedTuple):
    """What one unit of flake area does to stray light, shape (flakes, 31) each.

    ``absorption`` and ``scattering`` enter Kubelka-Munk; ``mirrored`` is what the flake
    returns at a typical incidence, ``blocked`` its extinction there.
    """

    absorption: FloatArray
    scattering: FloatArray
    mirrored: FloatArray
    blocked: FloatArray


def infinite(absorption: FloatArray, scattering: FloatArray) -> FloatArray:
    """Reflectance factor at 45/0 of a film that hides, same shape as its arguments.

    R∞ = 1 + q − √(q² + 2q) with q = K/S, then the losses at the coat's surface, its
    mirror reflection left out: T(45) T(0) R∞ / (n² (1 − k2 R∞)).

    The transmissions of 45/0 hold for every view. With those of the view itself a
    solid would be 7 % darker at 110 degrees; the convention that solids have one colour
    at all angles is the paper's.

    References
    ----------
    Kubelka and Munk 1931; Saunderson, J. Opt. Soc. Am. 32 (1942) 727, without the
    specular term.
    """
    q = absorption / scattering
    # The same as 1 + q − √(q² + 2q), without its cancellation in deep black.
    inside = 1.0 / (1.0 + q + np.sqrt(q * q + 2.0 * q))
    seen = _surface_loss() * inside / (1.0 - INTERNAL_REFLECTION * inside)
    factors: FloatArray = seen
    return factors


@cache
def _surface_loss() -> float:
    return float(transmission(45.0) * transmission(0.0)) / COAT_INDEX**2


@cache
def pigment_absorption() -> FloatArray:
    """K of one part of each pigment, shape (pigments, 31)."""
    return np.array([pigment.absorption() for pigment in PIGMENTS])


@cache
def pigment_scattering() -> FloatArray:
    """S of one part of each pigment, shape (pigments, 31)."""
    return np.array([pigment.scatter() for pigment in PIGMENTS])


@cache
def flake_sums() -> FlakeSums:
    """What flakes do to stray light.

    References
    ----------
    K and S of a mixture are the sums of its parts: Duncan 1940, as restated by Allen
    1980. Interference flakes stand beside them, not in them, except for a share.
    """
    smooth, passed = typical()
    mirrored = smooth * of_flakes("smoothness")
    tint = np.array([[flake.kind == "interference"] for flake in FLAKES])
    lost = np.maximum(1.0 - mirrored - passed, 0.0)
    return FlakeSums(
        absorption=of_flakes("absorption") + LOSS_TO_DIFFUSE * lost,
        scattering=of_flakes("scattering") + TINT_OF_DIFFUSE * tint * mirrored,
        mirrored=mirrored,
        blocked=extinction(smooth),
    )


@cache
def typical() -> Response:
    """Response of every flake at the typical incidence, shape (flakes, 31)."""
    seen = [response(flake.films, TYPICAL_INCIDENCE_RAD) for flake in FLAKES]
    return Response(
        np.concatenate([one.reflectance for one in seen]),
        np.concatenate([one.transmittance for one in seen]),
    )


def extinction(reflected: FloatArray) -> FloatArray:
    """Share of a beam that one unit of flake area stops, shape (..., flakes, 31).

    Metal stops everything. What an interference flake stops is taken half from its
    transmittance at the typical incidence, half from its reflectance on the way itself,
    so that it never mirrors light that it does not stop.

    Parameters
    ----------
    reflected
        Reflectance on the way itself, shape (..., flakes, 31).
    """
    opaque = np.array([[flake.kind == "aluminium"] for flake in FLAKES])
    edges = of_flakes("absorption") + of_flakes("scattering")
    partly = (1.0 - typical().transmittance + reflected) / 2.0 + edges
    return np.where(opaque, 1.0, partly)


def of_flakes(field: str) -> FloatArray:
    """One number of every flake, shape (flakes, 1)."""
    return np.array([[float(getattr(flake, field))] for flake in FLAKES])
