"""The paper's own fit: one clamped quadratic by least squares over all pixels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from paintlink.model import FloatArray
from paintlink.sketch.transfer import decode_srgb, linear_srgb_to_lab, reflected_lab

Space = Literal["rgb", "lab"]

UNIT_DEG = 110.0
"""Angles are scaled by this, which keeps the equations well conditioned."""

CLAMPS_DEG = np.arange(20.0, 116.0)
POWERS = np.add.outer(np.arange(3), np.arange(3))
RIDGE = 1e-13
"""Relative: keeps a clamp below all pixels, where nothing varies, solvable."""


@dataclass(frozen=True, slots=True, eq=False)
class PaperFit:
    """Constant, linear and quadratic coefficient of min(θ, clamp)/110.

    Parameters
    ----------
    space
        What the channels are: linear sRGB reflectance, or Lab D65/10.
    coefficients
        Shape (3, 3): power, channel.
    """

    space: Space
    coefficients: FloatArray
    clamp_deg: float

    def lab(self, aspecular_deg: ArrayLike) -> FloatArray:
        """Lab D65/10 at the given angles, shape (..., 3)."""
        t = np.minimum(np.asarray(aspecular_deg, dtype=np.float64), self.clamp_deg)
        powers = (t / UNIT_DEG)[..., np.newaxis] ** np.arange(3)
        value: FloatArray = powers @ self.coefficients
        return linear_srgb_to_lab(value) if self.space == "rgb" else value


def paper_rgb(
    theta_deg: FloatArray, phi: FloatArray, encoded: FloatArray, exposure: float
) -> PaperFit:
    """The fit of linear sRGB as the paper writes it; rows are φ·(1, t, t²).

    References
    ----------
    The paper's matrix equation and the sentences on the clamp angle below it.
    """
    values = decode_srgb(encoded) / exposure
    return PaperFit("rgb", *clamped_least_squares(theta_deg, phi, values))


def paper_lab(
    theta_deg: FloatArray, phi: FloatArray, encoded: FloatArray, exposure: float
) -> PaperFit:
    """The same fit of Lab, as the paper advises for effect colours.

    Rows are weighted by φ^(1/3): that is how the noise of Lab grows in the shade.
    """
    root = np.cbrt(phi)
    values = root[:, np.newaxis] * reflected_lab(encoded, phi, exposure)
    return PaperFit("lab", *clamped_least_squares(theta_deg, root, values))


def clamped_least_squares(
    theta_deg: FloatArray, factor: FloatArray, values: FloatArray
) -> tuple[FloatArray, float]:
    """Coefficients (power, channel) and clamp angle of least squared error.

    The clamp is scanned with sums over bins that end at its steps, which costs the
    same for any number of pixels; the winner is solved again on the pixels by QR,
    because the normal equations lose half the digits.
    """
    clamp_deg = float(CLAMPS_DEG[np.argmin(_errors(theta_deg, factor, values))])
    t = np.minimum(theta_deg, clamp_deg) / UNIT_DEG
    rows = factor[:, np.newaxis] * np.vander(t, 3, increasing=True)
    basis, triangle = np.linalg.qr(rows)
    solution = np.linalg.lstsq(triangle, basis.T @ values, rcond=None)[0]
    return solution, clamp_deg


def _errors(
    theta_deg: FloatArray, factor: FloatArray, values: FloatArray
) -> FloatArray:
    """Squared error at each clamp, less the constant sum of squares."""
    bins = np.digitize(theta_deg, CLAMPS_DEG)
    t = theta_deg / UNIT_DEG
    squares = _sums(bins, [factor**2 * t**power for power in range(5)])
    products = np.stack(
        [_sums(bins, [factor * v * t**power for power in range(3)]) for v in values.T],
        axis=-1,
    )
    clamp = (CLAMPS_DEG / UNIT_DEG)[:, np.newaxis]
    gram = _clamped(squares, clamp ** np.arange(5))[:, POWERS]
    right = _clamped(products, (clamp ** np.arange(3))[..., np.newaxis])
    gram += RIDGE * np.trace(gram, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    explained: FloatArray = (np.linalg.solve(gram, right) * right).sum(axis=(1, 2))
    return -explained


def _sums(bins: NDArray[np.int64], columns: list[FloatArray]) -> FloatArray:
    size = CLAMPS_DEG.size + 1
    return np.stack([np.bincount(bins, column, size) for column in columns], axis=-1)


def _clamped(sums: FloatArray, powers: FloatArray) -> FloatArray:
    """Sums with t held at each clamp: pixels below as they are, all above at it."""
    below = np.cumsum(sums, axis=0)[:-1]
    above = sums[:, :1].sum(axis=0) - below[:, :1]
    total: FloatArray = below + powers * above
    return total
