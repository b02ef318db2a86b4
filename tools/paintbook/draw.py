"""Random formulas, the way a colourist would begin: a main toner and its neighbours.

Every function fills an array of parts by weight, shape (n, toners), one column of the
mixing bench at a time; amounts are log-uniform.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink_simulators.paint.flakes import FLAKES
from paintlink_simulators.paint.toners import CODES, TONERS

Mask = NDArray[np.bool_]
Columns = NDArray[np.int64]
Rng = np.random.Generator

MAX_TONERS = 8
LEAST_PARTS = 0.05
HUNDRED = 10_000
"""A formula in hundredths of a part."""


def columns(*prefixes: str) -> Columns:
    """Columns of the toners whose code begins so."""
    return np.array([i for i, code in enumerate(CODES) if code.startswith(prefixes)])


WHITE, FROST = CODES.index("W10"), CODES.index("W12")
BLACKS = columns("N")
# In the order of the bench, which is the order round the hue circle.
COLOURS = columns("Y", "O", "R", "M", "V", "B", "G")
OPAQUE = np.array([CODES.index(c) for c in ("Y30", "Y34", "O40", "R51", "R54", "G82")])
ALUMINIUM = columns("A")
INTERFERENCE = columns("P")
FLOP_CONTROL = CODES.index("F90")
CLEAR_COLOURS = np.array([i for i in COLOURS if i not in OPAQUE])


def solids(count: int, rng: Rng) -> FloatArray:
    """Formulas without flakes: a quarter neutrals, a sixth tinted whites."""
    parts = np.zeros((count, len(TONERS)))
    kind = rng.random(count)
    white, neutral = kind < 0.14, (kind >= 0.14) & (kind < 0.44)
    colour = kind >= 0.44
    _put(parts, rng, white, WHITE, (1.95, 2.0))
    _put(parts, rng, neutral, WHITE, (-1.5, 2.0))
    _put(parts, rng, neutral, rng.choice(BLACKS, count), (-1.0, 1.6))
    _put(
        parts,
        rng,
        white & _chance(rng, count, 0.7),
        rng.choice(BLACKS, count),
        (-2.5, 0.3),
    )
    for chance in (1.0, 0.5):
        traced = (white | neutral) & _chance(rng, count, chance)
        _put(parts, rng, traced, rng.choice(COLOURS, count), (-1.5, 0.6))
    _colours(parts, rng, colour, COLOURS, (0.6, 2.0))
    _put(parts, rng, colour & _chance(rng, count, 0.75), WHITE, (-0.5, 2.0))
    black = colour & _chance(rng, count, 0.4)
    _put(parts, rng, black, rng.choice(BLACKS, count), (-1.3, 1.0))
    opaque = colour & _chance(rng, count, 0.2)
    _put(parts, rng, opaque, rng.choice(OPAQUE, count), (-0.3, 1.6))
    return quantised(parts)


def effects(count: int, rng: Rng) -> FloatArray:
    """Formulas with flakes: two fifths on pearl, the others on aluminium."""
    parts = np.zeros((count, len(TONERS)))
    pearl = _chance(rng, count, 0.42)
    metallic = ~pearl
    flake = (-0.3, 1.95)
    _put(parts, rng, pearl, rng.choice(INTERFERENCE, count), flake)
    second = pearl & _chance(rng, count, 0.25)
    _put(parts, rng, second, rng.choice(INTERFERENCE, count), flake)
    beside = metallic | (pearl & _chance(rng, count, 0.5))
    _put(parts, rng, beside, rng.choice(ALUMINIUM, count), flake)
    second = metallic & _chance(rng, count, 0.45)
    _put(parts, rng, second, rng.choice(ALUMINIUM, count), flake)
    _colours(parts, rng, _chance(rng, count, 0.85), CLEAR_COLOURS, (-0.3, 1.7))
    black = _chance(rng, count, 0.55)
    _put(parts, rng, black, rng.choice(BLACKS, count), (-1.3, 1.3))
    night = metallic & _chance(rng, count, 0.12)
    _put(parts, rng, night, rng.choice(BLACKS, count), (1.0, 2.3))
    _put(parts, rng, _chance(rng, count, 0.30), WHITE, (-1.0, 1.3))
    _put(parts, rng, _chance(rng, count, 0.12), FROST, (-0.3, 1.3))
    _put(parts, rng, _chance(rng, count, 0.35), FLOP_CONTROL, (-1.0, 1.0))
    return quantised(parts)


def relatives(prime: FloatArray, count: int, rng: Rng) -> FloatArray:
    """Formulas near each prime, shape (n, count, toners).

    Every toner moves by some per cent, one of them by more; metallics also trade some
    flake for the next grade.
    """
    parts = np.repeat(prime[:, np.newaxis], count, axis=1)
    width = rng.uniform(0.03, 0.12, (len(prime), count, 1))
    parts = parts * np.exp(width * rng.standard_normal(parts.shape))
    chosen = np.where(parts > 0.0, rng.random(parts.shape), -1.0).argmax(axis=2)
    step = np.exp(rng.choice([-0.22, -0.12, 0.12, 0.22], chosen.shape))
    index = (*np.indices(chosen.shape), chosen)
    parts[index] *= step
    return quantised(_regraded(parts.reshape(-1, len(TONERS)), rng)).reshape(
        parts.shape
    )


def quantised(parts: FloatArray) -> FloatArray:
    """Hundredths of a part that add up to exactly 100.00, at most `MAX_TONERS` of them.

    Traces below `LEAST_PARTS` and the smallest toners beyond the limit are left out;
    the remainder of rounding goes to the largest.
    """
    share = parts / parts.sum(axis=1, keepdims=True) * 100.0
    limit = -np.partition(-share, MAX_TONERS, axis=1)[:, MAX_TONERS : MAX_TONERS + 1]
    share = np.where((share >= LEAST_PARTS) & (share > limit), share, 0.0)
    share = share / share.sum(axis=1, keepdims=True) * HUNDRED
    hundredths = np.rint(share)
    rows = np.arange(len(parts))
    hundredths[rows, hundredths.argmax(axis=1)] += HUNDRED - hundredths.sum(axis=1)
    return hundredths / 100.0


def _colours(
    parts: FloatArray,
    rng: Rng,
    wanted: Mask,
    colours: Columns,
    span: tuple[float, float],
) -> None:
    """Add a main colour to the wanted rows, and up to two neighbours on the circle."""
    count = len(parts)
    main = rng.integers(0, len(colours), count)
    _put(parts, rng, wanted, colours[main], span)
    for chance in (0.6, 0.4):
        aside = main + rng.integers(-3, 4, count)
        near = wanted & _chance(rng, count, chance)
        low, high = span
        _put(parts, rng, near, colours[aside % len(colours)], (low - 1.0, high - 0.3))


def _regraded(parts: FloatArray, rng: Rng) -> FloatArray:
    """Two fifths of the metallics with part of a flake traded for a neighbour grade."""
    rows = np.arange(len(parts))
    flake = ALUMINIUM[parts[:, ALUMINIUM].argmax(axis=1)]
    other = np.clip(
        flake + rng.choice([-1, 1], len(parts)), ALUMINIUM[0], ALUMINIUM[-1]
    )
    area = np.array([one.area for one in FLAKES[: len(ALUMINIUM)]])
    ratio = area[flake - ALUMINIUM[0]] / area[other - ALUMINIUM[0]]
    traded = parts[rows, flake] * rng.uniform(0.08, 0.35, len(parts))
    traded = np.where(_chance(rng, len(parts), 0.4) & (other != flake), traded, 0.0)
    parts[rows, flake] -= traded
    parts[rows, other] += traded * ratio
    return parts


def _put(
    parts: FloatArray,
    rng: Rng,
    wanted: Mask,
    toner: int | Columns,
    span: tuple[float, float],
) -> None:
    """Add 10^U(span) parts of a toner to the wanted rows."""
    amount = 10.0 ** rng.uniform(*span, len(parts))
    rows = np.arange(len(parts))
    parts[rows, toner] += np.where(wanted, amount, 0.0)


def _chance(rng: Rng, count: int, chance: float) -> Mask:
    return rng.random(count) < chance
