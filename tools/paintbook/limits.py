"""Which candidates a colour book would show at all."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintbook.colours import MID, Paints
from paintlink.color import LEAVES, Leaf, lab_to_lch
from paintlink.model import FloatArray

BRIGHTEST_FACE = 155.0
WEAKEST_FLOP = 0.3
STEEP_FLOP, STEEP_BELOW_L = 22.0, 14.0
"""The paper: colours with an extreme flop index are very dark."""

STRONGEST_TRAVEL = 90.0
"""In units of the chroma index; beyond it pearls look like no car."""

LARGEST_ROOT = 65_000
RED_EFFECTS = LEAVES.index(Leaf("effect", "red"))

HUE_ENDS_DEG = np.array([45.0, 115.0, 240.0, 320.0, 360.0])
CHROMA_CEILINGS = np.array([80.0, 95.0, 55.0, 70.0, 62.0])
"""Highest chroma of a solid up to each hue: what real pigments reach."""


DARK_ROOM, LIGHT_ROOM, LIGHTEST = 2.4, 3.0, 102.0
"""Chroma per unit of L* above black, and below a white that is none."""


def sound(paints: Paints) -> NDArray[np.bool_]:
    """Which solids are no more chromatic than real ones, shape (n,)."""
    lightness, chroma, hue = lab_to_lch(paints.lab[:, MID] / 100.0).T
    sector = np.digitize(np.nan_to_num(hue), HUE_ENDS_DEG[:-1])
    ends = np.minimum(DARK_ROOM * lightness, LIGHT_ROOM * (LIGHTEST - lightness))
    below: NDArray[np.bool_] = chroma <= np.minimum(CHROMA_CEILINGS[sector], ends)
    return below


def presentable(paints: Paints, *, reddest: float = np.inf) -> NDArray[np.bool_]:
    """Which effect paints darken steadily, within what is seen on cars, shape (n,).

    Parameters
    ----------
    reddest
        Chroma at 45 degrees that no red may reach.
    """
    lightness = paints.lab[:, :, 0] / 100.0
    steady = (np.diff(lightness, axis=1) < 0.0).all(axis=1)
    steep = (paints.flop > STEEP_FLOP) & (lightness[:, MID] >= STEEP_BELOW_L)
    too_red = (paints.leaf == RED_EFFECTS) & (chroma(paints) >= reddest)
    shown: NDArray[np.bool_] = (
        steady
        & ~steep
        & ~too_red
        & (paints.flop >= WEAKEST_FLOP)
        & (lightness.max(axis=1) <= BRIGHTEST_FACE)
        & (paints.chroma_index() <= STRONGEST_TRAVEL)
        & (paints.root.max(axis=(1, 2)) < LARGEST_ROOT)
    )
    return shown


def chroma(paints: Paints) -> FloatArray:
    """Chroma at 45 degrees, shape (n,)."""
    return lab_to_lch(paints.lab[:, MID] / 100.0)[:, 1]
