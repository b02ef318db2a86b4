"""How sure the first rank is, given how well a reading repeats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.color import FORMULAS
from paintlink.model import ColorSpec, FloatArray, Match

DRAWS = 400
REPEATABILITY = 0.1
"""Mean ΔE between repeated readings of one panel; invented, like the instruments."""

MEAN_LENGTH = float(np.sqrt(8.0 / np.pi))
"""Mean length of a vector of three standard normal numbers."""


@dataclass(frozen=True, slots=True)
class Confidence:
    """How sure the first rank is.

    Parameters
    ----------
    stays_first
        Share of draws within the repeatability of the reading in which the first
        paint stays first.
    margin
        Total of the second paint minus that of the first; None without a second.
    repeatability
        Mean ΔE between a reading and its repetition that was assumed.
    """

    stays_first: float
    margin: float | None
    repeatability: float


def confidence(
    spec: ColorSpec,
    matches: tuple[Match, ...],
    repeatability: float = REPEATABILITY,
) -> Confidence:
    """Confidence in the first of some matches.

    The reading is drawn anew with the same spread in L, a and b at every angle; the
    same target always gets the same draws. Only paints on the list compete, so give a
    list that reaches some way beyond the repeatability.
    """
    best = matches[0]
    target = spec.lab(*best.angles_deg)
    spread = repeatability / MEAN_LENGTH
    drawn = target + spread * _normal(target.size).reshape(DRAWS, *target.shape)
    totals = _totals(target, drawn, matches)
    first = totals[0] <= totals.min(axis=0)
    margin = matches[1].total - best.total if len(matches) > 1 else None
    return Confidence(float(first.mean()), margin, repeatability)


def _normal(count: int) -> FloatArray:
    """Normal numbers, the same every time, shape (DRAWS, count).

    Hashed counters turned into normal numbers by Box and Muller: `numpy.random` would
    cost a cold start 10 ms.

    References
    ----------
    Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA 2014.
    """
    half = -(-DRAWS * count // 2)
    bits = np.arange(1, 2 * half + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        bits = (bits ^ (bits >> np.uint64(shift))) * np.uint64(factor)
    even = ((bits ^ (bits >> np.uint64(31))) >> np.uint64(11)) * 2.0**-53
    length, turn = np.sqrt(-2.0 * np.log1p(-even[:half])), 2.0 * np.pi * even[half:]
    normal = np.concatenate([length * np.cos(turn), length * np.sin(turn)])
    return normal[: DRAWS * count].reshape(DRAWS, count)


def _totals(
    target: FloatArray, drawn: FloatArray, matches: tuple[Match, ...]
) -> FloatArray:
    """Total of each match against each drawn reading, shape (matches, draws)."""
    steps = np.array([[d[2:5] for d in match.differences] for match in matches])
    paints = (target - steps)[:, np.newaxis]
    formula = FORMULAS[matches[0].formula]
    at_angles = formula(paints, drawn[np.newaxis], np.array(matches[0].angles_deg))
    totals: FloatArray = at_angles.sum(axis=-1)
    return totals
