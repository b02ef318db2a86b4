"""The light seen through each basis function, for every visible normal."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview import disc
from paintlink.preview.arrays import Float32Array
from paintlink.preview.basis import TERMS, THETA_MAX_DEG, chebyshev
from paintlink.preview.environment import Environment

SIZE = 128
BINS = 1024
TEXELS_AT_ONCE = 16


def base_table(environment: Environment) -> Float32Array:
    """Light times each basis function, shape (SIZE, SIZE, channels * TERMS).

    Notes
    -----
    E_k(n) = sum over lamps of R T_k(theta) max(n.l, 0), theta being the angle between
    the lamp and the mirror direction of the view. Each normal first sorts its light
    into bins of sin(theta / 2), then all basis functions are summed over the bins.
    """
    normals = disc.normals(SIZE)
    reached = disc.needed(SIZE)
    table = np.zeros((SIZE, SIZE, environment.channels * TERMS), dtype=np.float32)
    table[reached] = _integrals(normals[reached], environment)
    return table


def _integrals(normals: Float32Array, environment: Environment) -> Float32Array:
    directions, flux = environment.lamps()
    towards = np.ascontiguousarray(directions.T)
    terms = chebyshev(_bin_angles_deg())
    blocks = [
        _histogram(normals[start : start + TEXELS_AT_ONCE], towards, flux) @ terms
        for start in range(0, len(normals), TEXELS_AT_ONCE)
    ]
    return np.concatenate(blocks).reshape(len(normals), -1).astype(np.float32)


def _histogram(
    normals: Float32Array, towards: Float32Array, flux: Float32Array
) -> FloatArray:
    """Light arriving in each bin of the aspecular angle, (normals, channels, BINS)."""
    arriving = np.maximum(normals @ towards, 0.0)
    bins = _bin_of(disc.mirror_directions(normals) @ towards)
    return np.array([
        [np.bincount(which, weight * channel, BINS) for channel in flux.T]
        for which, weight in zip(bins, arriving, strict=True)
    ])


def _bin_of(cosine: Float32Array) -> NDArray[np.intp]:
    half_sine = np.sqrt(np.maximum(0.5 - 0.5 * cosine, 0.0))
    scale = np.float32((BINS - 1) / np.sin(np.radians(THETA_MAX_DEG) / 2.0))
    bins: NDArray[np.intp] = np.minimum(half_sine * scale, BINS - 1).astype(np.intp)
    return bins


def _bin_angles_deg() -> FloatArray:
    """Angle each bin stands for; the last one holds everything past the limit."""
    limit = np.sin(np.radians(THETA_MAX_DEG) / 2.0)
    half_sine = np.minimum((np.arange(BINS) + 0.5) / (BINS - 1), 1.0) * limit
    angles: FloatArray = np.degrees(2.0 * np.arcsin(half_sine))
    return angles
