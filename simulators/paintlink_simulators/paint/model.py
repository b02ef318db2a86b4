"""From formulas to reflectance factors: mirrored flake light over a diffuse base.

The film is sprayed to hiding, so only ratios of parts matter. The mirror reflection of
the clearcoat itself is left out, as every multi-angle instrument leaves it out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink_simulators.paint import base, shine
from paintlink_simulators.paint.toners import (
    FLAKE_COLUMNS,
    FLOP_CONTROL_COLUMN,
    PIGMENT_COLUMNS,
    TONERS,
)

BLOCK = 1024
"""Paints computed at once: enough for BLAS, few enough for the cache."""


def reflect(
    amounts: ArrayLike,
    aspecular_deg: ArrayLike,
    *,
    illumination_deg: ArrayLike = 45.0,
    spread: ArrayLike = 1.0,
    area: ArrayLike = 1.0,
) -> FloatArray:
    """Reflectance factors of formulas, shape (n, geometries, 31).

    They exceed 1 near the mirror direction of effect paints. Those of solids are the
    same at every angle.

    Parameters
    ----------
    amounts
        Parts by weight in the order of `TONERS`, shape (n, toners) or (toners,).
    aspecular_deg, illumination_deg
        In-plane geometries, see `optics.rays`.
    spread, area
        Factors on the tilt spread and the area of all flakes, one or one a paint: how
        the paint was sprayed.

    Raises
    ------
    InputError
        For amounts that are negative, not finite, without any colour, or of another
        shape; for a geometry that does not reach a panel.
    """
    parts = _checked(amounts)
    aspecular, illumination = np.broadcast_arrays(
        np.atleast_1d(np.asarray(aspecular_deg, dtype=np.float64)),
        np.atleast_1d(np.asarray(illumination_deg, dtype=np.float64)),
    )
    seen = shine.mirrors(tuple(aspecular.tolist()), tuple(illumination.tolist()))
    spreads, areas = (np.broadcast_to(one, len(parts)) for one in (spread, area))
    factors = np.empty((len(parts), *seen.reflectance.shape[::2]))
    for start in range(0, len(parts), BLOCK):
        block = slice(start, start + BLOCK)
        factors[block] = _reflect(parts[block], seen, spreads[block], areas[block])
    return factors


def _reflect(
    parts: FloatArray, seen: shine.Mirrors, spread: FloatArray, area: FloatArray
) -> FloatArray:
    """`reflect` for one block of paints, with checked amounts."""
    pigments, weights = parts[:, PIGMENT_COLUMNS], parts[:, FLAKE_COLUMNS]
    flakes = weights * base.of_flakes("area")[:, 0] * area[:, np.newaxis]
    absorbed = pigments @ base.pigment_absorption()
    scattered = pigments @ base.pigment_scattering()
    beam = absorbed / 2.0 + scattered
    disturbance = shine.disturbance(
        flakes.sum(axis=1),
        parts[:, FLOP_CONTROL_COLUMN],
        weight=weights.sum(axis=1),
        haze=scattered.mean(axis=1),
    )
    sums = base.flake_sums()
    diffuse = base.infinite(
        absorbed + flakes @ sums.absorption, scattered + flakes @ sums.scattering
    )
    # Light that flakes have mirrored never reaches the base.
    mirrored = (flakes @ sums.mirrored) / (flakes @ sums.blocked + 2.0 * beam) / 2.0
    factors = shine.lobe(flakes, seen, spread * disturbance, beam)
    return factors + ((1.0 - mirrored) * diffuse)[:, np.newaxis]


def _checked(amounts: ArrayLike) -> FloatArray:
    parts = np.atleast_2d(np.asarray(amounts, dtype=np.float64))
    if parts.ndim != 2 or parts.shape[1] != len(TONERS):
        msg = f"a formula has {len(TONERS)} amounts, got an array of {parts.shape}"
        raise InputError(msg)
    possible = np.isfinite(parts) & (parts >= 0.0)
    if not possible.all():
        row, toner = np.argwhere(~possible)[0]
        msg = (
            f"formula {row + 1}: {parts[row, toner]:g} parts of {TONERS[toner].code}: "
            "amounts must be finite and not negative"
        )
        raise InputError(msg)
    coloured = parts[:, :FLOP_CONTROL_COLUMN].sum(axis=1) > 0.0
    if not coloured.all():
        msg = (
            f"formula {int(np.argmin(coloured)) + 1} has neither pigment nor flake: "
            "add one"
        )
        raise InputError(msg)
    return parts
