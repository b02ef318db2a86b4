"""Small cells of equal aspecular angle and equal φ, the grain of the robust fit.

Averages are taken of encoded values: noise of dark pixels is even there, and biased
once decoded.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.sketch.transfer import reflected_lab
from paintlink.sketch.values import BoolArray

PHI_STEPS = 32
CELLS = 181 * (PHI_STEPS + 1)
LEVELS = 65536
LEAST_PIXELS = 4
LEAST_LEFT = 3
LEAST_SHARE = 0.25

CellIds = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Pixels:
    """Pixels of a fit, shape (n,) or (n, 3), with the cell each belongs to."""

    theta_deg: FloatArray
    phi: FloatArray
    encoded: FloatArray
    cell: CellIds
    exposure: float


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """One row per cell: mean angle, mean φ, Lab D65/10 and number of pixels."""

    theta_deg: FloatArray
    phi: FloatArray
    lab: FloatArray
    count: NDArray[np.int64]

    @property
    def weight(self) -> FloatArray:
        """Pixels times φ^(2/3): the noise of Lab grows as φ falls."""
        weight: FloatArray = self.count * np.cbrt(self.phi) ** 2
        return weight


def pixels(
    theta_deg: FloatArray, phi: FloatArray, encoded: FloatArray, exposure: float
) -> Pixels:
    """Pixels sorted into cells of 1 degree by 1/32 of φ."""
    across = np.minimum(phi * PHI_STEPS, PHI_STEPS).astype(np.int64)
    cell = theta_deg.astype(np.int64) * (PHI_STEPS + 1) + across
    return Pixels(theta_deg, phi, encoded, cell, exposure)


def median_cells(pixels: Pixels) -> Cells:
    """Cells with the median of each channel, where four pixels or more share one."""
    count = np.bincount(pixels.cell, minlength=CELLS)
    used = count >= LEAST_PIXELS
    encoded = np.stack(
        [_medians(pixels.cell, channel, count)[used] for channel in pixels.encoded.T],
        axis=-1,
    )
    everything = np.ones(pixels.cell.shape, dtype=np.bool_)
    theta, phi = _means(pixels, everything)[used, :2].T
    lab = reflected_lab(encoded, phi, pixels.exposure)
    return Cells(theta, phi, lab, count[used])


def mean_cells(pixels: Pixels, inlier: BoolArray) -> Cells:
    """Cells with the mean of their inliers, where enough pixels are left."""
    before = np.bincount(pixels.cell, minlength=CELLS)
    count = np.bincount(pixels.cell[inlier], minlength=CELLS)
    used = (count >= LEAST_LEFT) & (count >= LEAST_SHARE * before)
    means = _means(pixels, inlier)[used]
    theta, phi = means[:, 0], means[:, 1]
    lab = reflected_lab(means[:, 2:], phi, pixels.exposure)
    return Cells(theta, phi, lab, count[used])


def _means(pixels: Pixels, used: BoolArray) -> FloatArray:
    """Mean θ, φ and encoded channels of every cell, shape (cells, 5)."""
    cell = pixels.cell[used]
    columns = (pixels.theta_deg, pixels.phi, *pixels.encoded.T)
    sums = [np.bincount(cell, column[used], minlength=CELLS) for column in columns]
    count = np.maximum(np.bincount(cell, minlength=CELLS), 1)
    means: FloatArray = np.stack(sums, axis=-1) / count[:, np.newaxis]
    return means


def _medians(
    cell: CellIds, channel: FloatArray, count: NDArray[np.int64]
) -> FloatArray:
    """Median of one channel in every cell, by one sort of cell and value together."""
    codes = np.rint(channel * (LEVELS - 1)).astype(np.int64)
    ordered = np.sort((cell * LEVELS + codes).astype(np.int32))
    first = np.cumsum(count) - count
    last = max(ordered.size - 1, 0)
    low = ordered[np.minimum(first + np.maximum(count - 1, 0) // 2, last)] % LEVELS
    high = ordered[np.minimum(first + count // 2, last)] % LEVELS
    median: FloatArray = (low + high) / (2.0 * (LEVELS - 1))
    return median
