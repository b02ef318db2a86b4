"""The light seen through each term of a paint, for every visible normal."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview import disc
from paintlink.preview.arrays import Float32Array
from paintlink.preview.basis import TERMS, far_side
from paintlink.preview.environment import Environment
from paintlink.preview.spline import END_DEG, splines
from paintlink.preview.view import FRONT, View

SIZE = 192
COARSE_SIZE = 128
BINS = 1024
TEXELS_AT_ONCE = 16


def base_table(
    environment: Environment, view: View = FRONT, *, coarse: bool = False
) -> Float32Array:
    """Light times each term of a paint, shape (size, size, channels * TERMS).

    Parameters
    ----------
    coarse
        Half the texels, for tables of which several are mixed.

    Notes
    -----
    E_k(n) = sum over lamps of R B_k(theta) max(n.l, 0), theta being the angle between
    the lamp and the mirror direction of the view. Each normal first sorts its light
    into bins of sin(theta / 2), then all terms are summed over the bins. The last term
    counts light beyond the mirror direction only, as seen from the normal.
    """
    size = COARSE_SIZE if coarse else SIZE
    normals = disc.normals(size)
    reached = disc.needed(size)
    table = np.zeros((size, size, environment.channels * TERMS), dtype=np.float32)
    table[reached] = _integrals(normals[reached], environment, view)
    return table


def _integrals(
    normals: Float32Array, environment: Environment, view: View
) -> Float32Array:
    directions, flux = environment.lamps()
    towards = np.ascontiguousarray(view.inward(directions).T)
    terms = splines(_bin_angles_deg())
    blocks = []
    for start in range(0, len(normals), TEXELS_AT_ONCE):
        some = normals[start : start + TEXELS_AT_ONCE]
        blocks.append(_terms(some, towards, flux, terms))
    return np.concatenate(blocks).reshape(len(normals), -1).astype(np.float32)


def _terms(
    normals: Float32Array,
    towards: Float32Array,
    flux: Float32Array,
    terms: FloatArray,
) -> FloatArray:
    """Sums over all lamps, shape (normals, channels, TERMS)."""
    mirror = disc.mirror_directions(normals)
    along_normal, along_mirror = normals @ towards, mirror @ towards
    arriving = np.maximum(along_normal, 0.0)
    bins = _bin_of(along_mirror)
    light = np.array([
        [np.bincount(which, weight * channel, BINS) for channel in flux.T]
        for which, weight in zip(bins, arriving, strict=True)
    ])
    arriving *= _share_beyond(along_normal, along_mirror, normals[:, 2:])
    arriving *= FAR_SIDE[bins]
    return np.concatenate([light @ terms, (arriving @ flux)[..., None]], axis=2)


def _share_beyond(
    along_normal: Float32Array, along_mirror: Float32Array, cosine: Float32Array
) -> Float32Array:
    """1 straight beyond the mirror direction, 0 towards the normal, even turning.

    Parameters
    ----------
    along_normal, along_mirror
        Cosines of the lamps to normal and mirror direction, shape (n, lamps).
    cosine
        Of the mirror direction to the normal, shape (n, 1).
    """
    across = np.sqrt(np.maximum(1.0 - along_mirror**2, 0.0) * (1.0 - cosine**2))
    turn = (along_normal - cosine * along_mirror) / np.maximum(across, 1e-6)
    share: Float32Array = 0.5 - 0.5 * np.clip(turn, -1.0, 1.0)
    return share


def _bin_of(cosine: Float32Array) -> NDArray[np.intp]:
    half_sine = np.sqrt(np.maximum(0.5 - 0.5 * cosine, 0.0))
    scale = np.float32((BINS - 1) / np.sin(np.radians(END_DEG) / 2.0))
    bins: NDArray[np.intp] = np.minimum(half_sine * scale, BINS - 1).astype(np.intp)
    return bins


def _bin_angles_deg() -> FloatArray:
    """Angle each bin stands for; the last one holds everything past the limit."""
    limit = np.sin(np.radians(END_DEG) / 2.0)
    half_sine = np.minimum((np.arange(BINS) + 0.5) / (BINS - 1), 1.0) * limit
    angles: FloatArray = np.degrees(2.0 * np.arcsin(half_sine))
    return angles


FAR_SIDE = far_side(_bin_angles_deg()).astype(np.float32)
