"""How rough a clearcoat is, from its gloss reading."""

from __future__ import annotations

import numpy as np

from paintlink.model import Gloss

USUAL_ANGLE_DEG = 60.0
USUAL_GLOSS = Gloss(90.0, USUAL_ANGLE_DEG)

ROUGHNESS = (
    0.002, 0.004, 0.006, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.2, 0.5,
)  # fmt: skip
GLOSS_GU = {
    20.0: (78.5, 70.0, 60.3, 43.5, 29.4, 20.8, 11.6, 7.2, 3.5, 2.0, 1.3, 0.3, 0.1),
    60.0: (88.7, 87.2, 85.0, 78.8, 69.9, 61.2, 47.3, 37.5, 25.3, 18.1, 13.6, 4.5, 0.7),
    85.0: (99.1, 96.3, 93.1, 84.9, 73.4, 62.9, 46.7, 35.6, 22.5, 15.3, 10.9, 3.1, 0.4),
}
"""Gloss units by gloss angle, one for each roughness: GGX integrated, index 1.5."""


def roughness_of(gloss: Gloss | None) -> float:
    """GGX width of a coat, one of ``ROUGHNESS``.

    Gloss at an angle the table does not hold is read at the nearest angle it does;
    without an angle, at 60 degrees.
    """
    known = gloss or USUAL_GLOSS
    table = GLOSS_GU[_column(known)]
    step = np.interp(known.value_gu, table[::-1], range(len(table))[::-1])
    return ROUGHNESS[round(float(step))]


def assumption(gloss: Gloss | None) -> str:
    """What `roughness_of` had to assume, in words; empty when nothing."""
    if gloss is None:
        usual = f"{USUAL_GLOSS.value_gu:g} GU at {USUAL_GLOSS.angle_deg:g}°"
        return f"gloss not measured, {usual} assumed"
    if gloss.angle_deg is None:
        return f"angle of the gloss not known, {USUAL_ANGLE_DEG:g}° assumed"
    if gloss.angle_deg not in GLOSS_GU:
        return f"gloss at {gloss.angle_deg:g}° taken as gloss at {_column(gloss):g}°"
    return ""


def _column(gloss: Gloss) -> float:
    """The angle of the table nearest to the angle of the gloss."""
    angle = USUAL_ANGLE_DEG if gloss.angle_deg is None else gloss.angle_deg
    return min(GLOSS_GU, key=lambda column: abs(column - angle))
