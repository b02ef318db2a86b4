"""How much of a change each aspecular angle takes, and the rate of travel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from paintlink.model import FloatArray

FACE_DEG, MIDDLE_DEG, FLOP_DEG = 15.0, 45.0, 110.0

STEEPEST_REST = ((FLOP_DEG - MIDDLE_DEG) / (FLOP_DEG - FACE_DEG)) ** 2
"""Rest at 45 degrees of a channel that levels off at 110 degrees."""


def face_weight(angles_deg: FloatArray, vertex_deg: float) -> FloatArray:
    """1 at the face, falling as the paper's quadratic to 0 at the vertex."""
    reach = np.maximum(vertex_deg - angles_deg, 0.0) / (vertex_deg - FACE_DEG)
    weight: FloatArray = reach * reach
    return weight


def flop_weight(angles_deg: FloatArray) -> FloatArray:
    """0 at the face, rising quadratically to 1 at the flop."""
    reach = np.clip((angles_deg - FACE_DEG) / (FLOP_DEG - FACE_DEG), 0.0, 1.0)
    weight: FloatArray = reach * reach
    return weight


class Rate(NamedTuple):
    """How fast one channel travels from face to flop.

    ``rest`` is the part of its travel still to go at 45 degrees, None without travel;
    ``vertex_deg`` is where it levels off, None where no clamped quadratic passes
    through its three samples.
    """

    rest: float | None
    vertex_deg: float | None

    def __str__(self) -> str:
        if self.rest is None:
            return "no travel"
        if self.vertex_deg is not None:
            return f"levels off at {self.vertex_deg:.1f}°"
        slow = 0.0 < self.rest <= 1.0
        return "levels off beyond 110°" if slow else "not monotone"


def rate(y15: float, y45: float, y110: float) -> Rate:
    """Rate of travel of a channel with these end points and this middle.

    With m the rest at 45 degrees, the vertex lies at (45 − 15√m)/(1 − √m).
    """
    if y15 == y110:
        return Rate(None, None)
    rest = (y45 - y110) / (y15 - y110)
    if not 0.0 <= rest <= STEEPEST_REST:
        return Rate(rest, None)
    root = rest**0.5
    vertex_deg = (MIDDLE_DEG - FACE_DEG * root) / (1.0 - root)
    return Rate(rest, min(vertex_deg, FLOP_DEG))
