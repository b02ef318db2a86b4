"""The clearcoat: a rough dielectric surface over the paint."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from paintlink.model import FloatArray
from paintlink.preview import disc
from paintlink.preview.arrays import Float32Array
from paintlink.preview.environment import Environment

INDEX = 1.5
FINE_SIZE = 384
COARSE_SIZE = 128
RINGS = 12
RING_SPACING = np.radians(3.0)


def coat_table(environment: Environment, roughness: float) -> Float32Array:
    """Light reflected by the coat for every visible normal, (size, size, channels).

    Notes
    -----
    Split sum: the light prefiltered around the mirror direction times the directional
    albedo of the lobe.
    """
    size = FINE_SIZE if roughness <= 0.02 else COARSE_SIZE
    normals = disc.normals(size)
    reached = disc.needed(size)
    visible = normals[reached]
    mirror = disc.mirror_directions(visible)
    table = np.zeros((size, size, environment.channels), dtype=np.float32)
    table[reached] = _prefiltered(environment, mirror, roughness)
    table[reached] *= _albedo(visible[:, 2], roughness)[:, None]
    return table


def fresnel(cosine: FloatArray, index: float = INDEX) -> FloatArray:
    """Share of unpolarised light a dielectric surface reflects."""
    inside = np.sqrt(1.0 - (1.0 - cosine**2) / index**2)
    across = (cosine - index * inside) / (cosine + index * inside)
    along = (index * cosine - inside) / (index * cosine + inside)
    reflected: FloatArray = (across**2 + along**2) / 2.0
    return reflected


def _prefiltered(
    environment: Environment, mirror: Float32Array, roughness: float
) -> Float32Array:
    """Light averaged over the lobe around each mirror direction, (n, channels)."""
    right, up = _frame(mirror)
    total = np.zeros((len(mirror), environment.channels), dtype=np.float32)
    whole = 0.0
    for x, y, z, weight in _lobe(roughness):
        total += weight * environment.seen_along(x * right + y * up + z * mirror)
        whole += weight
    return total / np.float32(whole)


def _lobe(roughness: float) -> NDArray[np.float32]:
    """Directions of a GGX lobe about (0, 0, 1) and their weights, shape (n, 4).

    Rings hold equal steps of the cubed share of the lobe, so that its long tail is
    resolved; each ring holds as many directions as its circumference asks for.
    """
    tail = (1.0 - np.arange(RINGS + 1) / RINGS) ** 3
    share = 1.0 - (tail[:-1] + tail[1:]) / 2.0
    cosine = np.sqrt((1.0 - share) / (1.0 + (roughness**2 - 1.0) * share))
    angle = 2.0 * np.arccos(cosine)
    rings = [
        _ring(theta, weight * max(np.cos(theta), 0.0), turn)
        for turn, (theta, weight) in enumerate(zip(angle, -np.diff(tail), strict=True))
    ]
    return np.concatenate(rings).astype(np.float32)


def _ring(theta: float, weight: float, turn: int) -> FloatArray:
    count = int(np.clip(np.ceil(2.0 * np.pi * np.sin(theta) / RING_SPACING), 1, 64))
    azimuth = 2.0 * np.pi * (np.arange(count) / count + turn * 0.618)
    return np.stack(
        [
            np.sin(theta) * np.cos(azimuth),
            np.sin(theta) * np.sin(azimuth),
            np.full(count, np.cos(theta)),
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


def _albedo(cosine_view: Float32Array, roughness: float) -> Float32Array:
    """Light reflected by a white surrounding, at n.v, shape (n,)."""
    at = np.linspace(0.0, 1.0, 65) ** 2
    table = [_albedo_at(max(float(cosine), 1e-3), roughness) for cosine in at]
    return np.interp(cosine_view, at, table).astype(np.float32)


def _albedo_at(cosine_view: float, roughness: float) -> float:
    share, azimuth = np.meshgrid((np.arange(96) + 0.5) / 96, (np.arange(96) + 0.5) / 96)
    z = np.sqrt((1.0 - share) / (1.0 + (roughness**2 - 1.0) * share))
    x = np.sqrt(1.0 - z**2) * np.cos(2.0 * np.pi * azimuth)
    sine_view = np.sqrt(1.0 - cosine_view**2)
    meeting = sine_view * x + cosine_view * z
    cosine_light = 2.0 * meeting * z - cosine_view
    seen = (meeting > 0.0) & (cosine_light > 0.0)
    m, h, light = meeting[seen], z[seen], cosine_light[seen]
    masking = 1.0 + _smith(cosine_view, roughness) + _smith(light, roughness)
    reflected = fresnel(m) * m / (cosine_view * h) / masking
    return float(reflected.sum() / share.size)


def _smith(cosine: ArrayLike, roughness: float) -> FloatArray:
    tangent = 1.0 / np.square(cosine) - 1.0
    hidden: FloatArray = (np.sqrt(1.0 + roughness**2 * tangent) - 1.0) / 2.0
    return hidden
