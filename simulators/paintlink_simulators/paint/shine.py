"""Light that one flake mirrors straight from the lamp into the detector."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators.paint.base import extinction, of_flakes
from paintlink_simulators.paint.films import response
from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.lobe import tilt_density
from paintlink_simulators.paint.optics import COAT_INDEX, Rays, rays

SHADOWING = 0.62
"""Overlap of the ways in and out among flakes: 1 for independent ways, 0.5 for one and
the same. From 0.5 on a lobe returns no more than its flakes reflect. An assumption."""

FLOP_CONTROL_TILT, FLOP_CONTROL_HALF = 1.1, 0.35
PIGMENT_TILT = 0.275
"""How much flop control and scattering pigment tilt flakes: assumptions, set to the
flop indices of real paints."""


class Mirrors(NamedTuple):
    """All flakes at some geometries; both arrays have the shape (g, flakes, 31)."""

    rays: Rays
    reflectance: FloatArray
    extinction: FloatArray


@lru_cache(maxsize=64)
def mirrors(
    aspecular_deg: tuple[float, ...], illumination_deg: tuple[float, ...]
) -> Mirrors:
    """Reflectance and extinction of one unit of flake area at these geometries."""
    ways = rays(aspecular_deg, illumination_deg)
    smooth = np.stack(
        [response(flake.films, ways.incidence_rad).reflectance for flake in FLAKES],
        axis=1,
    )
    return Mirrors(ways, smooth * of_flakes("smoothness"), extinction(smooth))


def disturbance(
    flakes: FloatArray,
    flop_control: FloatArray,
    *,
    weight: FloatArray,
    haze: FloatArray,
) -> FloatArray:
    """Factor on the tilt spread of the flakes in each paint, shape (n,).

    Parameters
    ----------
    flakes, weight
        Their area and their parts by weight, summed, shape (n,).
    flop_control
        Parts, shape (n,).
    haze
        Mean scattering of the pigments, shape (n,).
    """
    return (
        1.0
        + FLOP_CONTROL_TILT * _share(flop_control, FLOP_CONTROL_HALF * weight)
        + PIGMENT_TILT * _share(haze, flakes)
    )


def _share(part: FloatArray, rest: FloatArray) -> FloatArray:
    return np.divide(part, part + rest, out=np.zeros_like(part), where=part > 0.0)


def lobe(
    flakes: FloatArray, seen: Mirrors, spread: FloatArray, beam: FloatArray
) -> FloatArray:
    """Reflectance factor of the flakes alone, shape (n, g, 31).

    R = π T(θi) T(θv)/n² · ¼ Σ a D(γ) ρ / (2 Q μi μv Σ a E + B (μi + μv)): single
    reflection in a deep layer of flakes and absorber, from the conservation of flux.

    Parameters
    ----------
    flakes
        Area of each flake, shape (n, flakes).
    spread
        Factor on the tilt spread, shape (n,).
    beam
        Extinction of the pigments for directed light, K/2 + S, shape (n, 31).

    References
    ----------
    The split into mirrored and diffuse light: US 4 711 580 (1987). Tilt, refraction and
    films on the facet: Germer and Marx, Appl. Opt. 43 (2004) 1266. The prefactor and
    the shadowing are this project's derivation.
    """
    inward = seen.rays.cos_in[:, np.newaxis, np.newaxis]
    outward = seen.rays.cos_out[:, np.newaxis, np.newaxis]
    scale = np.pi * seen.rays.transmission[:, np.newaxis, np.newaxis] / COAT_INDEX**2
    turned = flakes * _densities(seen.rays.tilt_rad, spread) / 4.0
    stopped = 2.0 * SHADOWING * inward * outward * (flakes @ seen.extinction)
    stopped += beam * (inward + outward)
    factors: FloatArray = scale * (turned @ seen.reflectance)
    # A paint without flakes and without absorption stops nothing, and mirrors nothing.
    np.divide(factors, stopped, out=factors, where=stopped > 0.0)
    return factors.swapaxes(0, 1)


def _densities(tilt_rad: FloatArray, spread: FloatArray) -> FloatArray:
    """Tilt density of each flake at each tilt, shape (g, n, flakes)."""
    width = np.radians(of_flakes("spread_deg")[:, 0]) * spread[:, np.newaxis]
    return tilt_density(
        tilt_rad[:, np.newaxis, np.newaxis], width, of_flakes("tail")[:, 0]
    )
