"""Which pixels of a painting take part in a fit, and why the others do not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil, sqrt
from types import MappingProxyType
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink.sketch.values import (
    BoolArray,
    Painting,
    PixelArray,
    PixelGeometry,
)

Reason = Literal[
    "kept", "background", "edge", "gloss", "grazing", "unchanged", "clipped",
    "near-white", "transparent", "stray",
]  # fmt: skip
"""What became of a pixel; ``stray`` is set by the robust fit, all others here."""

REASONS: tuple[Reason, ...] = get_args(Reason)
ReasonMap = NDArray[np.uint8]
"""Index into `REASONS`, one for each pixel."""

PIXEL_CAP = 300_000
EDGE_PX = 4
LEAST_THETA_DEG = 12.0
LEAST_PHI = 0.12
CODE = 1.0 / 255.0
CHANGED_CODES = 2.0
CHANGED_CODES_LOSSY = 8.0
CLIPPED = 254.0 / 255.0
NEAR_WHITE = 0.94
ROUNDING = 1e-6
"""Of single precision, so that a difference of two codes is not more than two."""


@dataclass(frozen=True, slots=True, eq=False)
class Selection:
    """The pixels of a fit and the fate of every other.

    Parameters
    ----------
    step
        Every step-th row and column was looked at; the maps have that size.
    reasons
        Shape (rows, columns).
    theta_deg, phi
        Of the kept pixels, shape (n,).
    encoded
        Of the kept pixels, shape (n, 3).
    painted_deg
        Aspecular angles of all changed pixels, kept or not, shape (m,), m >= n.
    """

    step: int
    reasons: ReasonMap
    theta_deg: FloatArray
    phi: FloatArray
    encoded: FloatArray
    painted_deg: FloatArray


def select(painting: Painting, geometry: PixelGeometry, start: PixelArray) -> Selection:
    """Changed foreground pixels without gloss, clipping and transparency.

    The first reason that holds, in the order of `REASONS`, is the one that counts.

    Parameters
    ----------
    start
        Encoded sRGB of the picture the artist began with, shape (height, width, 3).

    Raises
    ------
    InputError
        When the pictures differ in size.
    """
    _same_size(painting, geometry, start)
    step = thinning(geometry.mask)
    thin = np.s_[::step, ::step]
    theta = geometry.theta_deg[thin].astype(np.float64)
    phi = geometry.phi[thin].astype(np.float64)
    encoded = painting.encoded[thin].astype(np.float64)
    # Where the file was compressed with losses, small changes prove nothing.
    codes = CHANGED_CODES_LOSSY if painting.lossy else CHANGED_CODES
    limit = codes * CODE + ROUNDING
    drops: dict[Reason, BoolArray] = {
        "background": ~geometry.mask[thin],
        "edge": ~eroded(geometry.mask, step),
        "gloss": theta < LEAST_THETA_DEG,
        "grazing": phi < LEAST_PHI,
        "unchanged": _largest(np.abs(encoded - start[thin])) <= limit,
        "clipped": _largest(encoded) >= CLIPPED - ROUNDING,
        "near-white": encoded.min(axis=-1) > NEAR_WHITE,
        "transparent": _transparent(painting, thin),
    }
    reasons = _first(drops, theta.shape)
    kept = reasons == REASONS.index("kept")
    painted = kept | (reasons >= REASONS.index("clipped"))
    return Selection(
        step, reasons, theta[kept], phi[kept], encoded[kept], theta[painted]
    )


def counts(reasons: ReasonMap) -> Mapping[Reason, int]:
    """How many pixels of a reason map met each fate."""
    numbers = np.bincount(reasons.ravel(), minlength=len(REASONS)).tolist()
    return MappingProxyType(dict(zip(REASONS, numbers, strict=True)))


def thinning(mask: BoolArray) -> int:
    """Step that leaves at most 300 000 pixels of the mask.

    It is odd, so that every place inside the 8-pixel blocks of a JPEG is met.
    """
    step = ceil(sqrt(np.count_nonzero(mask) / PIXEL_CAP))
    return max(1, step + 1 - step % 2)


def eroded(mask: BoolArray, step: int) -> BoolArray:
    """The thinned mask without the pixels within four steps of its outline.

    Four rounds of erosion by the four neighbours, done at once.
    """
    height, width = mask.shape
    padded = np.pad(mask, EDGE_PX)
    inside = mask[::step, ::step].copy()
    reach = range(-EDGE_PX, EDGE_PX + 1)
    for down, right in product(reach, reach):
        if abs(down) + abs(right) <= EDGE_PX:
            rows = slice(EDGE_PX + down, EDGE_PX + down + height, step)
            columns = slice(EDGE_PX + right, EDGE_PX + right + width, step)
            inside &= padded[rows, columns]
    return inside


def _same_size(painting: Painting, geometry: PixelGeometry, start: PixelArray) -> None:
    found, wanted = painting.encoded.shape[:2], geometry.mask.shape
    if found != wanted or start.shape[:2] != wanted:
        msg = (
            f"the painting has {found[1]} x {found[0]} pixels, the set-up "
            f"{wanted[1]} x {wanted[0]}: export it at full size, uncropped"
        )
        raise InputError(msg)


def _first(drops: Mapping[Reason, BoolArray], shape: tuple[int, ...]) -> ReasonMap:
    reasons = np.zeros(shape, dtype=np.uint8)
    for reason, dropped in reversed(list(drops.items())):
        reasons[dropped] = REASONS.index(reason)
    return reasons


def _largest(values: FloatArray) -> FloatArray:
    """Largest of the three channels, faster than a reduction over a short axis."""
    largest: FloatArray = np.maximum(values[..., 0], values[..., 1])
    return np.maximum(largest, values[..., 2])


def _transparent(painting: Painting, thin: tuple[slice, slice]) -> BoolArray:
    if painting.alpha is None:
        return np.zeros(painting.encoded[thin].shape[:2], dtype=np.bool_)
    return np.asarray(painting.alpha[thin] < 1.0 - CODE - ROUNDING)
