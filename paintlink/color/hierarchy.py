"""The tree a paint library is browsed by: 2 sets of 7 families, 14 leaves.

The tree is the paper's; it gives no limits, so every number here is an assumption of
this project. Colours are judged at 45 degrees, the angle that shows the paint between
the glare of the flakes and their shadow, and the only one an ordinary
spectrophotometer has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from paintlink.color.lab import channels, chroma, hue_deg
from paintlink.model import Finish, FloatArray

PaintSet = Literal["solid", "effect"]
Family = Literal["blue", "green", "yellow", "red", "light", "medium", "dark"]

CHROMA_LIMIT_SOLID = 8.0
"""From this C* on a solid has a hue name: tinted whites and greys lie below."""

CHROMA_LIMIT_EFFECT = 6.0
"""Lower for metallics and pearls, whose flakes thin the colour: a silver with a clear
blue cast is sold as a blue."""

HUE_STARTS_DEG: tuple[tuple[float, Family], ...] = (
    (45.0, "yellow"),
    (115.0, "green"),
    (215.0, "blue"),
    (340.0, "red"),
)
"""Where each hue family begins, counter-clockwise, up to the next one.

Each limit lies between two of the elementary hues of CIELAB (red near 25, yellow 90,
green 165, blue 245), moved so that orange and gold count as yellow and violet as blue.
"""

LIGHT_FROM_L = 62.0
MEDIUM_FROM_L = 35.0
"""Rough thirds of what paints reach at 45 degrees, from blacks to whites."""

FAMILIES: tuple[Family, ...] = (
    "blue",
    "green",
    "yellow",
    "red",
    "light",
    "medium",
    "dark",
)

NO_LEAF = -1
"""Index of a paint whose finish is not known."""


@dataclass(frozen=True, slots=True)
class Leaf:
    """One drawer of the library; ``effect`` holds metallics and pearls together."""

    paint_set: PaintSet
    family: Family

    @property
    def chromatic(self) -> bool:
        """Whether the family is a hue rather than a value."""
        return FAMILIES.index(self.family) < 4


LEAVES: tuple[Leaf, ...] = tuple(
    Leaf(paint_set, family) for paint_set in ("solid", "effect") for family in FAMILIES
)
"""All leaves in the order of the paper's text; indices refer to this order."""

_SET_OFFSET: dict[Finish, int] = {
    "solid": 0,
    "metallic": len(FAMILIES),
    "pearl": len(FAMILIES),
}


def leaf(lab45: ArrayLike, finish: Finish) -> Leaf | None:
    """Leaf of one paint, or None when its finish is unknown.

    Parameters
    ----------
    lab45
        Lab D65/10 at 45 degrees aspecular, shape (3,).
    """
    index = leaf_indices(np.reshape(np.asarray(lab45), (1, 3)), [finish])[0]
    return None if index == NO_LEAF else LEAVES[index]


def leaf_indices(lab45: ArrayLike, finishes: Sequence[Finish]) -> NDArray[np.int64]:
    """Index into `LEAVES` of each paint, `NO_LEAF` where the finish is unknown.

    Parameters
    ----------
    lab45
        Lab D65/10 at 45 degrees aspecular, shape (n, 3).
    finishes
        One finish for each paint.
    """
    L, a, b = channels(lab45)
    offset = np.array([_SET_OFFSET.get(finish, NO_LEAF) for finish in finishes])
    limit = np.where(offset == 0, CHROMA_LIMIT_SOLID, CHROMA_LIMIT_EFFECT)
    family = np.where(chroma(a, b) >= limit, _hue_family(a, b), _value_family(L))
    return np.where(offset == NO_LEAF, NO_LEAF, offset + family).astype(np.int64)


def _hue_family(a: FloatArray, b: FloatArray) -> NDArray[np.int64]:
    starts = [start for start, _ in HUE_STARTS_DEG]
    # Slot 0 lies before the first start: it belongs to the family that wraps round.
    families = [FAMILIES.index(family) for _, family in HUE_STARTS_DEG]
    slots = np.array([families[-1], *families], dtype=np.int64)
    return slots[np.digitize(hue_deg(a, b), starts)]


def _value_family(L: FloatArray) -> NDArray[np.int64]:
    dark = FAMILIES.index("dark")
    return dark - np.digitize(L, [MEDIUM_FROM_L, LIGHT_FROM_L]).astype(np.int64)
