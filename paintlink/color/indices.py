"""Indices of colour travel from face to flop.

Every index has two forms over the same arithmetic: ``*_array`` takes Lab of many
paints, shape (..., 3, 3) with the aspecular angles 15, 45 and 110 degrees on the second
axis from the end, and gives NaN where the index is undefined; the form without the
suffix takes one paint, shape (3, 3), and gives None there. Other angles are never put
in their place. A missing value is a NaN.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from paintlink.color.lab import channels, chroma
from paintlink.model import ColorSpec, FloatArray

TRAVEL_ANGLES_DEG = (15.0, 45.0, 110.0)
"""Face, the angle in between, and flop."""

ACHROMATIC_CHROMA = 1.0
"""Below this chroma a measured hue is noise, so nothing is derived from it."""

UNSTABLE_L45 = 1.0
"""Below this L* at 45 degrees the Flop Index is dominated by its denominator."""


@dataclass(frozen=True, slots=True)
class Travel:
    """Travel of one paint from face to flop; None where an index is undefined.

    ``unstable`` marks a Flop Index that rests on an L* below 1 at 45 degrees.
    """

    flop_index: float | None = None
    chroma_index: float | None = None
    hue_shift_index: float | None = None
    hue_travel_deg: float | None = None
    unstable: bool = False


def travel(spec: ColorSpec) -> Travel:
    """All indices of a specification; all None without Lab at 15, 45 and 110."""
    if not set(TRAVEL_ANGLES_DEG) <= set(spec.angles_deg):
        return Travel()
    lab = spec.lab(*TRAVEL_ANGLES_DEG)
    return Travel(
        flop_index=flop_index(lab),
        chroma_index=chroma_index(lab),
        hue_shift_index=hue_shift_index(lab),
        hue_travel_deg=hue_travel(lab),
        unstable=bool(lab[1, 0] < UNSTABLE_L45),
    )


def flop_index(lab: ArrayLike) -> float | None:
    """Lightness travel of one paint; see `flop_index_array`."""
    return _defined(flop_index_array(lab))


def chroma_index(lab: ArrayLike) -> float | None:
    """Chroma travel of one paint; see `chroma_index_array`."""
    return _defined(chroma_index_array(lab))


def hue_shift_index(lab: ArrayLike) -> float | None:
    """Off-radial travel of one paint; see `hue_shift_index_array`."""
    return _defined(hue_shift_index_array(lab))


def hue_travel(lab: ArrayLike) -> float | None:
    """Hue angle travel of one paint in degrees; see `hue_travel_array`."""
    return _defined(hue_travel_array(lab))


def flop_index_array(lab: ArrayLike) -> FloatArray:
    """Flop Index, shape (...): 2.69 (L15 − L110)^1.11 / L45^0.86.

    Exactly 0 where the flop is not darker than the face, as on every solid. Undefined
    where an L* is missing or negative, or where L45 is 0 and the flop is darker.

    Notes
    -----
    Grows without bound as L45 nears 0: most values beyond 25 belong to very dark
    paints, see `UNSTABLE_L45`.

    References
    ----------
    Alman 1987; the paper's Flop Index equation.
    """
    L15, L45, L110 = _lightness(lab)
    drop = np.maximum(L15 - L110, 0.0)
    known = (L15 >= 0.0) & (L45 >= 0.0) & (L110 >= 0.0)
    defined = known & ((L45 > 0.0) | (drop == 0.0))
    index = 2.69 * drop**1.11 / np.where(L45 > 0.0, L45, 1.0) ** 0.86
    return np.where(defined, index, np.nan)


def chroma_index_array(lab: ArrayLike) -> FloatArray:
    """Chroma Index |C15 − C110| in units of Lab ΔE, shape (...).

    References
    ----------
    The paper's Chroma Index equation.
    """
    a15, b15, a110, b110 = _face_and_flop(lab)
    index: FloatArray = np.abs(chroma(a15, b15) - chroma(a110, b110))
    return index


def hue_shift_index_array(lab: ArrayLike) -> FloatArray:
    """Hue Shift Index in units of Lab ΔE, shape (...).

    Distance of the flop colour from the line through the neutral point and the face
    colour. Undefined where the face is achromatic. A turn of 180 degrees gives 0: look
    at `hue_travel_array` beside it.

    References
    ----------
    The paper's Hue Shift Index equation.
    """
    a15, b15, a110, b110 = _face_and_flop(lab)
    C15 = chroma(a15, b15)
    chromatic = C15 >= ACHROMATIC_CHROMA
    off_line = np.abs(a110 * b15 - a15 * b110)
    return np.where(chromatic, off_line / np.where(chromatic, C15, 1.0), np.nan)


def hue_travel_array(lab: ArrayLike) -> FloatArray:
    """Hue angle at the flop minus hue angle at the face, shape (...).

    Degrees in (−180, 180], positive from red towards yellow. Undefined where face or
    flop is achromatic.
    """
    a15, b15, a110, b110 = _face_and_flop(lab)
    # Adding 0.0 turns -0.0 into 0.0, which keeps a half turn at +180.
    turn = (a15 * b110 - a110 * b15) + 0.0
    angle = np.degrees(np.arctan2(turn, a15 * a110 + b15 * b110))
    least = np.minimum(chroma(a15, b15), chroma(a110, b110))
    return np.where(least >= ACHROMATIC_CHROMA, angle, np.nan)


def _lightness(lab: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    L, _, _ = channels(lab)
    return L[..., 0], L[..., 1], L[..., 2]


def _face_and_flop(
    lab: ArrayLike,
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    _, a, b = channels(lab)
    return a[..., 0], b[..., 0], a[..., 2], b[..., 2]


def _defined(index: FloatArray) -> float | None:
    value = float(index)
    return None if math.isnan(value) else value
