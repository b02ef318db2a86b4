"""The clearcoat: a rough dielectric surface over the paint."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.preview import disc
from paintlink.preview.arrays import Float32Array
from paintlink.preview.environment import Environment
from paintlink.preview.view import FRONT, View

INDEX = 1.5
FINE_SIZE = 384
COARSE_SIZE = 128
SHARP = 0.02
RINGS = 24
SHARP_RINGS = 12
RING_SPACING_RAD = np.radians(3.0)
MOST_IN_A_RING = 48


def coat_table(
    environment: Environment, roughness: float, view: View = FRONT
) -> Float32Array:
    """Light reflected by the coat for every visible normal, (size, size, channels).

    Notes
    -----
    A microfacet surface: GGX normals, Smith masking, exact Fresnel reflection. The
    facets are taken from rings of equal probability around each normal.

    References
    ----------
    Walter and others, Microfacet Models for Refraction through Rough Surfaces,
    EGSR 2007.
    """
    size = FINE_SIZE if roughness <= SHARP else COARSE_SIZE
    reached = disc.needed(size)
    visible = disc.normals(size)[reached]
    visible[:, 2] = np.maximum(visible[:, 2], 1e-3)
    table = np.zeros((size, size, environment.channels), dtype=np.float32)
    table[reached] = _reflected(environment, visible, roughness, view)
    return table


def fresnel(cosine: Float32Array, index: float = INDEX) -> Float32Array:
    """Share of unpolarised light a dielectric surface reflects."""
    inside = np.sqrt(1.0 - (1.0 - cosine**2) / index**2)
    across = (cosine - index * inside) / (cosine + index * inside)
    along = (index * cosine - inside) / (index * cosine + inside)
    reflected: Float32Array = (across**2 + along**2) / 2.0
    return reflected


def _reflected(
    environment: Environment, normal: Float32Array, roughness: float, view: View
) -> Float32Array:
    """Radiance towards the viewer, (n, channels)."""
    right, up = _frame(normal)
    total = np.zeros((len(normal), environment.channels), dtype=np.float32)
    for x, y, z, weight in _facets(roughness):
        facet = x * right + y * up + z * normal
        light = 2.0 * facet[:, 2:] * facet
        light[:, 2] -= 1.0
        share = _share(facet[:, 2], light, normal, roughness) * (weight / z)
        total += share[:, None] * environment.seen_along(view.outward(light))
    return total


def _share(
    meeting: Float32Array, light: Float32Array, normal: Float32Array, roughness: float
) -> Float32Array:
    """What one facet reflects, over the cosine between facet and normal, (n,).

    Parameters
    ----------
    meeting
        Cosine between facet and view.
    """
    cosine_view = normal[:, 2]
    cosine_light: Float32Array = np.einsum("nc,nc->n", light, normal)
    seen = (meeting > 0.0) & (cosine_light > 0.0)
    np.maximum(cosine_light, np.float32(1e-6), out=cosine_light)
    meeting = np.maximum(meeting, 1e-6).astype(np.float32)
    hidden = _smith(cosine_view, roughness) + _smith(cosine_light, roughness)
    reflected = fresnel(meeting) * meeting / (cosine_view * (1.0 + hidden))
    share: Float32Array = (reflected * seen).astype(np.float32)
    return share


def _facets(roughness: float) -> NDArray[np.float32]:
    """Facet normals about (0, 0, 1) and their probability, shape (n, 4).

    Rings hold equal steps of the cubed share of the facets, so that their long tail is
    resolved; each ring holds as many as its circumference asks for.
    """
    count = SHARP_RINGS if roughness <= SHARP else RINGS
    tail = (1.0 - np.arange(count + 1) / count) ** 3
    share = 1.0 - (tail[:-1] + tail[1:]) / 2.0
    cosine = np.sqrt((1.0 - share) / (1.0 + (roughness**2 - 1.0) * share))
    rings = [
        _ring(float(z), float(weight), turn)
        for turn, (z, weight) in enumerate(zip(cosine, -np.diff(tail), strict=True))
    ]
    return np.concatenate(rings).astype(np.float32)


def _ring(cosine: float, weight: float, turn: int) -> NDArray[np.float64]:
    sine = np.sqrt(1.0 - cosine**2)
    around = 2.0 * np.pi * 2.0 * sine / RING_SPACING_RAD
    count = int(np.clip(np.ceil(around), 1, MOST_IN_A_RING))
    azimuth = 2.0 * np.pi * (np.arange(count) / count + turn * 0.618)
    return np.stack(
        [
            sine * np.cos(azimuth),
            sine * np.sin(azimuth),
            np.full(count, cosine),
            np.full(count, weight / count),
        ],
        axis=1,
    )


def _frame(axis: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Two unit vectors across each axis, without a seam in the visible directions.

    Source: Duff and others, Building an Orthonormal Basis, Revisited, JCGT 6 (2017).
    """
    x, y, z = axis.T
    sign = np.copysign(np.float32(1.0), z)
    a = -1.0 / (sign + z)
    b = x * y * a
    right = np.stack([1.0 + sign * x * x * a, sign * b, -sign * x], axis=1)
    up = np.stack([b, sign + y * y * a, -y], axis=1)
    return right, up


def _smith(cosine: Float32Array, roughness: float) -> Float32Array:
    tangent = np.float32(1.0) / cosine**2 - np.float32(1.0)
    rough = np.sqrt(np.float32(1.0) + np.float32(roughness**2) * tangent)
    hidden: Float32Array = (rough - np.float32(1.0)) / np.float32(2.0)
    return hidden
