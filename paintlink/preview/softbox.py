"""A lamp every studio has: a rectangle of light with soft edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

NEGLIGIBLE = 10.0
"""Edge widths beyond which a lamp gives nothing: 1 / (1 + exp(10)) = 5e-5."""


@dataclass(frozen=True)
class Softbox:
    """A flat lamp at distance 1.

    Parameters
    ----------
    towards
        Direction of its middle.
    half_width, half_height
        Half the sides as seen from the object, tangents of angles.
    radiance
        In its middle.
    up
        Which way its height runs.
    edge
        Softness of the sides, same unit as the half sides.
    gradient
        How much brighter than the middle the lower side is, and darker the upper.
    """

    towards: tuple[float, float, float]
    half_width: float
    half_height: float
    radiance: float
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    edge: float = 0.012
    gradient: float = 0.0

    def seen_along(self, directions: Float32Array) -> Float32Array:
        """Radiance, shape (n,)."""
        axes = self._axes()
        seen = np.zeros(len(directions), dtype=np.float32)
        near = np.flatnonzero(directions @ axes[2] > self._least_cosine())
        across, up, depth = axes @ directions[near].T
        across, up = across / depth, up / depth
        width = _soft(self.half_width - np.abs(across), self.edge)
        height = _soft(self.half_height - np.abs(up), self.edge)
        slope = 1.0 - self.gradient * np.clip(up / self.half_height, -1.0, 1.0)
        seen[near] = np.float32(self.radiance) * width * height * slope
        return seen

    def _axes(self) -> Float32Array:
        depth = _unit(np.array(self.towards))
        across = _unit(np.cross(self.up, depth))
        return np.array([across, np.cross(depth, across), depth], dtype=np.float32)

    def _least_cosine(self) -> float:
        reach = NEGLIGIBLE * self.edge
        corner = np.hypot(self.half_width + reach, self.half_height + reach)
        return float(1.0 / np.hypot(1.0, corner))


def _soft(inside: Float32Array, edge: float) -> Float32Array:
    """Logistic step: 0 well outside, 1 well inside."""
    step: Float32Array = 0.5 + 0.5 * np.tanh(inside * np.float32(0.5 / edge))
    return step


def _unit(vector: FloatArray) -> FloatArray:
    length: FloatArray = vector / np.linalg.norm(vector)
    return length
