"""The colour a formula is wanted for, and how far another colour is from it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color import ciede2000, reflectance_to_lab
from paintlink.errors import InputError
from paintlink.model import FloatArray, Observer
from paintlink_simulators.paint import WAVELENGTHS_NM, reflect


@dataclass(frozen=True, slots=True, eq=False)
class Target:
    """Lab D65 at aspecular angles under light from 45 degrees.

    Parameters
    ----------
    aspecular_deg
        Shape (m,).
    lab
        Shape (m, 3).
    """

    aspecular_deg: FloatArray
    lab: FloatArray
    observer: Observer = "10"

    def __post_init__(self) -> None:
        angles = np.array(self.aspecular_deg, dtype=np.float64)
        lab = np.array(self.lab, dtype=np.float64)
        if not angles.size or lab.shape != (angles.size, 3):
            msg = f"a target needs L, a, b at each angle, got {lab.shape} values"
            raise InputError(msg)
        if not (np.isfinite(lab).all() and np.isfinite(angles).all()):
            msg = "a target needs finite angles and Lab values: measure it again"
            raise InputError(msg)
        for name, array in (("aspecular_deg", angles), ("lab", lab)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def predicted(self, parts: ArrayLike) -> FloatArray:
        """Lab of formulas at the angles of the target, shape (n, m, 3)."""
        factors = reflect(parts, self.aspecular_deg)
        flat = factors.reshape(-1, WAVELENGTHS_NM.size)
        lab = reflectance_to_lab(WAVELENGTHS_NM, flat, observer=self.observer)
        return lab.reshape(*factors.shape[:2], 3)

    def difference(self, lab: ArrayLike) -> FloatArray:
        """CIEDE2000 at each angle, shape (..., m)."""
        return ciede2000(self.lab, np.asarray(lab, dtype=np.float64))

    def mean_difference(self, lab: ArrayLike) -> FloatArray:
        """Mean CIEDE2000 over the angles, shape (...)."""
        mean: FloatArray = self.difference(lab).mean(axis=-1)
        return mean

    def misfit(self, lab: FloatArray) -> FloatArray:
        """Smooth stand-in for CIEDE2000, shape (..., 3·m): what is minimised.

        ΔL, ΔC and ΔH over the weights of CIEDE2000 at the target. ΔC and ΔH are the
        parts of (Δa, Δb) along and across the hue of the target, so that there is no
        seam at any hue.
        """
        along = self._along()
        delta = lab - self.lab
        turned = np.stack(
            [
                delta[..., 0],
                (delta[..., 1:] * along).sum(axis=-1),
                delta[..., 2] * along[:, 0] - delta[..., 1] * along[:, 1],
            ],
            axis=-1,
        )
        weighted: FloatArray = turned / self._weights()
        return weighted.reshape(*lab.shape[:-2], -1)

    def _along(self) -> FloatArray:
        """Unit vector of each hue, shape (m, 2)."""
        chroma = np.linalg.norm(self.lab[:, 1:], axis=1, keepdims=True)
        along: FloatArray = self.lab[:, 1:] / np.maximum(chroma, 1e-9)
        return along

    def _weights(self) -> FloatArray:
        """S_L, S_C, S_H without their hue terms, shape (m, 3)."""
        off = (self.lab[:, 0] - 50.0) ** 2
        chroma = np.linalg.norm(self.lab[:, 1:], axis=1)
        return np.stack(
            [
                1.0 + 0.015 * off / np.sqrt(20.0 + off),
                1.0 + 0.045 * chroma,
                1.0 + 0.015 * chroma,
            ],
            axis=-1,
        )
