"""Invented optics of the stand-in library: which lacquers exist, how effects travel.

Arrays hold one paint per row. The three angles of a design are 15, 45 and 110 aspecular
degrees: face, mid and flop. A real paint model may take the place of this module.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
MID = 3
LIGHTEST_FACE = 150.0
STEEP_FLOP, STEEP_BELOW_L = 22.0, 13.0
FLOP_LAW_SHAPE, FLOP_LAW_SCALE = 7.075, 1.6085
DECAYS_DEG = np.linspace(15.0, 60.0, 901)

# Hue, lightness and chroma of the most vivid lacquer around the hue circle.
VIVID_HUE, VIVID_LIGHTNESS, VIVID_CHROMA = np.array(
    [
        (0, 20, 35, 50, 65, 85, 100, 115, 135, 155, 180, 205, 230, 255, 275, 290, 310),
        (40, 40, 43, 56, 65, 78, 82, 72, 56, 48, 48, 50, 48, 42, 34, 26, 28),
        (58, 66, 76, 88, 92, 93, 85, 66, 55, 50, 44, 42, 45, 50, 58, 60, 53),
    ],
    dtype=np.float64,
)


def polar(chroma: Array, hue_deg: Array) -> Array:
    """Chroma and hue as a and b, shape (..., 2)."""
    hue = np.radians(hue_deg)
    return np.stack([chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1)


def most_vivid(lightness: Array, hue_deg: Array) -> Array:
    """Highest chroma of a lacquer of this lightness and hue."""
    peak = np.interp(hue_deg, VIVID_HUE, VIVID_LIGHTNESS, period=360.0)
    chroma = np.interp(hue_deg, VIVID_HUE, VIVID_CHROMA, period=360.0)
    dark = np.clip(lightness / peak, 0.0, 1.0) ** 0.8
    light = np.clip((102.0 - lightness) / (102.0 - peak), 0.0, 1.0) ** 0.85
    return np.asarray(chroma * np.minimum(dark, light))


def deal_flops(
    mid: Array, lean: Array, taken: Array, rng: np.random.Generator
) -> Array:
    """Flop index of each paint: quantiles of a gamma law, the steepest dealt out first.

    Each goes to the paint that leans to it most among those that can carry it.

    Parameters
    ----------
    mid
        Lab at 45 degrees, shape (n, 3).
    lean
        Flop index the family of the paint leans to.
    taken
        Flop indices that other paints hold already; the law leaves room for them.
    """
    wish = lean * np.exp(0.35 * rng.standard_normal(len(mid)))
    most = _steepest(mid[:, 0])
    flops = np.zeros(len(mid))
    for flop in _law(len(mid), taken)[::-1]:
        able = (flops == 0.0) & (most >= flop)
        if not able.any():
            msg = f"no paint is left that can have a flop index of {flop:.2f}"
            raise RuntimeError(msg)
        flops[np.argmax(np.where(able, wish, -1.0))] = flop
    return flops


def _law(paints: int, taken: Array) -> Array:
    """Quantiles of the gamma law, ascending, less those nearest to the taken ones."""
    flop = np.linspace(0.0, 80.0, 80001)
    density = flop ** (FLOP_LAW_SHAPE - 1.0) * np.exp(-flop / FLOP_LAW_SCALE)
    share = np.cumsum(density) / density.sum()
    count = paints + taken.size
    law = np.interp((np.arange(count) + 0.5) / count, share, flop)
    for value in taken:
        law = np.delete(law, np.argmin(np.abs(law - value)))
    return law


def flop_index(travel: Array, mid_lightness: Array) -> Array:
    """Flop index of a lightness travel from 15 to 110 degrees."""
    return np.asarray(2.69 * travel**1.11 / mid_lightness**0.86)


def _travel(flop: Array, mid_lightness: Array) -> Array:
    """Lightness travel that gives a flop index."""
    return np.asarray((flop * mid_lightness**0.86 / 2.69) ** (1.0 / 1.11))


def _steepest(mid_lightness: Array) -> Array:
    """Highest flop index a paint of this lightness at 45 degrees can carry."""
    low, high = _left_at_45(DECAYS_DEG[[0, -1]])
    up = (LIGHTEST_FACE - mid_lightness) / (1.0 - 0.8 * high)
    down = (mid_lightness - _darkest(mid_lightness)) / low
    flop = flop_index(np.minimum(up, down), mid_lightness)
    return np.where(mid_lightness < STEEP_BELOW_L, flop, np.minimum(flop, STEEP_FLOP))


def _darkest(mid_lightness: Array) -> Array:
    """Lowest lightness of the flop."""
    return 0.4 + 0.06 * mid_lightness


def design(
    mid: Array, flop: Array, pearl: NDArray[np.bool_], rng: np.random.Generator
) -> Array:
    """Lab at face, mid and flop, shape (n, 3, 3), with the given flop index."""
    lightness = _design_lightness(mid[:, 0], flop, rng)
    ab = _design_chroma(lightness, mid, rng) + _interference(mid, pearl, rng)
    return np.concatenate([lightness[:, :, None], ab], axis=2)


def _design_lightness(mid: Array, flop: Array, rng: np.random.Generator) -> Array:
    travel = _travel(flop, mid)
    left = 0.26 * np.exp(0.2 * rng.standard_normal(mid.size))
    left = np.maximum(left, 1.0 - (LIGHTEST_FACE - mid) / travel)
    left = np.minimum(left, (mid - _darkest(mid)) / travel)
    left = np.clip(left, *_left_at_45(DECAYS_DEG[[0, -1]]))
    return np.stack([mid + travel * (1.0 - left), mid, mid - travel * left], axis=1)


def _design_chroma(lightness: Array, mid: Array, rng: np.random.Generator) -> Array:
    """Colour at face, mid and flop as a and b, shape (n, 3, 2).

    Flakes that return more light raise chroma with lightness, each pigment at its own
    pace and with a little of another hue.
    """
    chroma, hue = _chroma(mid), _hue_deg(mid)
    pace = np.clip(0.85 + 0.35 * rng.standard_normal((2, chroma.size)), -0.3, 1.7)
    turn = 5.0 * rng.standard_normal((2, chroma.size))
    tint = rng.standard_normal((2, chroma.size, 2)) * [[[0.8, 1.4]], [[0.4, 0.8]]]
    face, flop = (
        chroma * ((lightness[:, i] + 16.0) / (mid[:, 0] + 16.0)) ** pace[i // 2]
        for i in (0, 2)
    )
    face = np.minimum(face, np.interp(hue, VIVID_HUE, VIVID_CHROMA, period=360.0))
    flop = np.minimum(flop, most_vivid(lightness[:, 2], hue))
    ends = [polar(face, hue + turn[0]) + tint[0], polar(flop, hue + turn[1]) + tint[1]]
    return np.stack([ends[0], mid[:, 1:], ends[1]], axis=1)


def _interference(
    mid: Array, pearl: NDArray[np.bool_], rng: np.random.Generator
) -> Array:
    """What pearls add to a and b: a colour at the face, its opposite at the flop."""
    hue = _hue_deg(mid) + 50.0 * rng.standard_normal(len(mid))
    chroma = np.where(pearl, np.abs(9.0 * rng.standard_normal(len(mid))), 0.0)
    return np.asarray(polar(chroma, hue)[:, None] * [[1.0], [0.0], [-0.3]])


def _chroma(lab: Array) -> Array:
    return np.hypot(lab[:, 1], lab[:, 2])


def _hue_deg(lab: Array) -> Array:
    return np.degrees(np.arctan2(lab[:, 2], lab[:, 1]))


def aspecular_curve(anchors: Array) -> Array:
    """Lab at the six angles through Lab at face, mid and flop, shape (n, 6, 3).

    Lightness falls exponentially; a and b are quadratic in that fall. The flakes seen
    at -15 lean a little less than those seen at 15, as if it were 12.4.
    """
    lightness = anchors[:, :, 0]
    left_at_45 = (lightness[:, 1] - lightness[:, 2]) / (
        lightness[:, 0] - lightness[:, 2]
    )
    decay = np.interp(left_at_45, _left_at_45(DECAYS_DEG), DECAYS_DEG)
    angles = np.array([12.4, *ANGLES_DEG[1:]])
    t = _left(angles, decay[:, None])[:, :, None]
    m = t[:, MID : MID + 1]
    face, mid, flop = (anchors[:, i : i + 1] for i in range(3))
    return np.asarray(
        face * t * (t - m) / (1.0 - m)
        + mid * t * (1.0 - t) / (m * (1.0 - m))
        + flop * (1.0 - t) * (m - t) / m
    )


def _left(angle_deg: Array, decay_deg: Array) -> Array:
    """Share of the fall from 15 to 110 degrees that is still to come at an angle."""
    end = np.exp(-110.0 / decay_deg)
    fall = (np.exp(-angle_deg / decay_deg) - end) / (np.exp(-15.0 / decay_deg) - end)
    return np.asarray(fall)


def _left_at_45(decay_deg: Array) -> Array:
    return _left(np.array(45.0), decay_deg)
