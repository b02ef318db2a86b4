"""A flexible profile of Lab against the aspecular angle, to tell stray strokes by.

Never the quadratic: measured against it the steep face of a real paint looks like
strokes, and would be deleted.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells, Pixels, mean_cells, median_cells
from paintlink.sketch.transfer import reflected_lab
from paintlink.sketch.values import BoolArray

BIN_DEG = 3.0
ROUNDS = 2
LEAST_SCALE = 0.35
SIGMA = 1.4826
"""Standard deviation of a normal distribution over its median deviation."""

LIMIT = 4.85
"""Length of the scaled residual a pixel may have: 3.5 · √3 · 0.8."""


@dataclass(frozen=True, slots=True, eq=False)
class Profile:
    """Lab at ascending angles, linear between them, and below the first as well."""

    theta_deg: FloatArray
    lab: FloatArray

    def __call__(self, theta_deg: FloatArray) -> FloatArray:
        """Lab at the given angles, shape (n, 3)."""
        at, lab = self.theta_deg, self.lab
        if at.size > 1:
            slope = (lab[1] - lab[0]) / (at[1] - at[0])
            at = np.concatenate([[0.0], at])
            lab = np.concatenate([[lab[0] - self.theta_deg[0] * slope], lab])
        return np.stack([np.interp(theta_deg, at, row) for row in lab.T], axis=-1)


def profile(cells: Cells, bin_deg: float = BIN_DEG) -> Profile:
    """Weighted running median of the cells over bins of aspecular angle."""
    number = (cells.theta_deg / bin_deg).astype(np.int64)
    _, bins = np.unique(number, return_inverse=True)
    weight = cells.weight
    total = np.bincount(bins, weight)
    theta = np.bincount(bins, weight * cells.theta_deg) / total
    lab = [_weighted_medians(bins, channel, weight) for channel in cells.lab.T]
    return Profile(theta, np.stack(lab, axis=-1))


def without_strays(pixels: Pixels) -> tuple[BoolArray, Cells]:
    """Which pixels agree with the others at their angle, and the cells of those."""
    cells = median_cells(pixels)
    lab = reflected_lab(pixels.encoded, pixels.phi, pixels.exposure)
    inlier = np.zeros(pixels.phi.shape, dtype=np.bool_)
    for _ in range(ROUNDS):
        if not cells.count.size:
            break
        inlier = _inliers(pixels, lab, profile(cells))
        cells = mean_cells(pixels, inlier)
    return inlier, cells


def _inliers(pixels: Pixels, lab: FloatArray, reference: Profile) -> BoolArray:
    residual = lab - reference(pixels.theta_deg)
    residual *= np.cbrt(pixels.phi)[:, np.newaxis]
    scale = np.maximum(LEAST_SCALE, SIGMA * np.median(np.abs(residual), axis=0))
    residual /= scale
    inlier: BoolArray = np.einsum("ij,ij->i", residual, residual) < LIMIT**2
    return inlier


def _weighted_medians(
    bins: NDArray[np.int64], values: FloatArray, weight: FloatArray
) -> FloatArray:
    """Median of the values in each bin, every bin being present."""
    order = np.lexsort((values, bins))
    running = np.cumsum(weight[order])
    total = np.bincount(bins, weight)
    middle = np.cumsum(total) - 0.5 * total
    return values[order][np.searchsorted(running, middle)]
