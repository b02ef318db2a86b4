"""The geometry as a picture: the paper's encoding, and how to tell it was altered."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from paintlink.errors import InputError
from paintlink.preview.arrays import Float32Array
from paintlink.sketch.geometry import bands
from paintlink.sketch.png import Codes, to_codes, to_values
from paintlink.sketch.values import PixelGeometry

THETA_SCALE_DEG = 180.0
CHECKS = (0.25, 0.5, 0.75, 1.0)
"""Red and green of four patches in the background that a gamma correction moves."""

CHECK_SIZE = 1.0 / 32.0
CHECK_AT = 1.0 / 64.0
TOLERANCE = 2.0 / 255.0


def geometry_codes(geometry: PixelGeometry, bits: int) -> Codes:
    """Samples of the geometry picture: red theta/180, green phi, blue the mask.

    Plain numbers without gamma. Pixels outside the mask are black but for four check
    patches at the upper left.
    """
    values = np.zeros((*geometry.mask.shape, 3), dtype=np.float32)
    for rows in bands(len(values)):
        inside = geometry.mask[rows]
        values[rows, :, 0] = geometry.theta_deg[rows] / THETA_SCALE_DEG * inside
        values[rows, :, 1] = geometry.phi[rows] * inside
        values[rows, :, 2] = inside
    for place, level in zip(_check_places(len(values)), CHECKS, strict=True):
        values[place] = (level, level, 0.0)
    return to_codes(np.clip(values, 0.0, 1.0), bits)


def from_values(values: Float32Array) -> PixelGeometry:
    """Geometry in a picture of another program, made the way of `geometry_codes`.

    Raises
    ------
    InputError
        When the picture was colour-managed, compressed with loss or painted on.
    """
    _require_checks(values)
    _require_mask(values)
    theta = values[..., 0] * np.float32(THETA_SCALE_DEG)
    phi, mask = values[..., 1], values[..., 2] > 0.5
    _require_possible(theta[mask], phi[mask])
    return PixelGeometry(theta, phi, mask)


def differs(values: Float32Array, codes: Codes) -> bool:
    """Whether a geometry picture holds other numbers than its recipe gives."""
    if values.shape != codes.shape:
        return True
    return any(
        float(np.abs(values[rows] - to_values(codes[rows])).max()) > TOLERANCE
        for rows in bands(len(codes))
    )


def _check_places(size: int) -> Iterator[tuple[slice, slice]]:
    side, start = max(4, round(size * CHECK_SIZE)), round(size * CHECK_AT)
    for index in range(len(CHECKS)):
        left = start + index * side
        yield slice(start, start + side), slice(left, left + side)


def _require_checks(values: Float32Array) -> None:
    for place, level in zip(_check_places(len(values)), CHECKS, strict=True):
        found = values[place]
        middle = found[len(found) // 4 : -len(found) // 4]
        off = float(np.abs(np.median(middle, axis=(0, 1)) - (level, level, 0.0)).max())
        if off > TOLERANCE:
            msg = (
                f"its check patch of {level:g} is off by {255 * off:.0f} codes of 255: "
                "a program converted its colours; use the geometry.png of the set-up "
                "or its recipe.json"
            )
            raise InputError(msg)


def _require_mask(values: Float32Array) -> None:
    blue = values[..., 2]
    between = int(np.count_nonzero((blue > TOLERANCE) & (blue < 1.0 - TOLERANCE)))
    if between:
        msg = (
            f"{between} pixels of its mask (blue) are neither 0 nor full: it was "
            "compressed with loss or resampled; use the geometry.png of the set-up"
        )
        raise InputError(msg)


def _require_possible(theta_deg: Float32Array, phi: Float32Array) -> None:
    """Refuse angles no surface can show: theta is at most 90° + acos(phi)."""
    limit = 90.0 + np.degrees(np.arccos(np.clip(phi - TOLERANCE, 0.0, 1.0)))
    wrong = int(np.count_nonzero(theta_deg > limit + TOLERANCE * THETA_SCALE_DEG))
    if wrong or not theta_deg.size:
        msg = (
            f"{wrong} of its {theta_deg.size} object pixels hold angles no surface "
            "can show: use the geometry.png of the set-up"
        )
        raise InputError(msg)
