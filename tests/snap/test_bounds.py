"""No bound may ever exceed the difference from a point of its box."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import Generator

from paintlink.color import FORMULAS
from paintlink.model import FloatArray
from paintlink.snap.bounds import PRUNING, Pruning
from paintlink.snap.boxes import Box
from paintlink.snap.conditions import Comparison
from paintlink.snap.scan import totals

AT = (15.0,)
CHUNK = 100_000

VECTORS = [
    ((50, 0, 0), (60, 0, 0), (70, 0, 0), 9.4705785636),
    (
        (50, 2.6772, -79.7751),
        (50, 0, -82.7485),
        (50, 0, -82.7485),
        0.4124483325,
    ),
    ((50, 20, 10), (45, 30, 5), (55, 40, 20), 3.8782808145),
    ((30, -25, 15), (28, -20, 10), (35, -10, 20), 2.1511174752),
    ((40, 15, -40), (38, 20, -50), (45, 25, -42), 0.6215415813),
    ((70, 1, -1), (68, -2, 0), (72, 0.5, 3), 1.0999958310),
    ((50, 10, 10), (40, 0, 0), (60, 20, 20), 0.0),
    ((130, 3, -2), (140, 5, -1), (150, 8, 4), 4.9461071447),
    ((25, 30, -60), (60, -40, 40), (80, -20, 60), 35.4043522696),
]
"""Target, lowest and highest corner, and the bound worked out by other code."""


@pytest.mark.parametrize(("target", "low", "high", "expected"), VECTORS)
def test_ciede2000_bound_meets_worked_values(
    target: tuple[float, ...],
    low: tuple[float, ...],
    high: tuple[float, ...],
    expected: float,
) -> None:
    box = Box(np.array([low], dtype=float), np.array([high], dtype=float))

    bound = PRUNING["ciede2000"].lower(np.array([target], dtype=float), box, AT)

    assert bound == pytest.approx(expected, abs=1e-7)


def test_lightness_falls_back_where_the_difference_is_not_monotone() -> None:
    target = np.array([[-16.0, 0.0, 0.0]])
    low, high = np.array([[124.0, 0.0, 0.0]]), np.array([[134.0, 0.0, 0.0]])
    inside = np.linspace(124.0, 134.0, 1001)[np.newaxis, np.newaxis] * [[[1], [0], [0]]]

    bound = PRUNING["ciede2000"].lower(target, Box(low, high), AT)
    least = totals(inside, Comparison(target, AT, FORMULAS["ciede2000"])).min()

    assert 124.0 < bound <= least < 134.0


@pytest.mark.parametrize("formula", sorted(FORMULAS))
def test_no_bound_exceeds_a_difference(formula: str) -> None:
    assert violations(formula, np.random.default_rng(5), 200_000) == 0


@pytest.mark.proof
@pytest.mark.timeout(600)
def test_ciede2000_bound_holds_for_ten_million_boxes() -> None:
    assert violations("ciede2000", np.random.default_rng(6), 10_000_000) == 0


def violations(formula: str, rng: Generator, boxes: int) -> int:
    """Boxes whose bound exceeds the difference from a point inside them."""
    found = 0
    for _ in range(boxes // CHUNK):
        target = colors(rng, 1)[..., 0]
        low, high, inside = some_boxes(rng, target)
        box = in_space(PRUNING[formula], Box(low, high), inside)
        seen_from = PRUNING[formula].coordinates(target)
        bound = PRUNING[formula].lower(seen_from, box, AT)
        difference = totals(inside, Comparison(target, AT, FORMULAS[formula]))
        found += int(np.count_nonzero(bound > difference))
    return found


def in_space(pruning: Pruning, box: Box, inside: FloatArray) -> Box:
    """The box, or one of the same size around the point where boxes are not in Lab."""
    if pruning.to_space is None:
        return box
    point = pruning.coordinates(inside.transpose(0, 2, 1)).transpose(0, 2, 1)
    return Box(point - (inside - box.low), point + (box.high - inside))


def some_boxes(
    rng: Generator, target: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Boxes of all sizes, far from the target and around it, and a point in each."""
    size = 10.0 ** rng.uniform(-4.0, 1.6, (1, 3, CHUNK))
    near = target[..., np.newaxis] + rng.normal(0.0, 1.0, (1, 3, CHUNK)) * size * 3.0
    low = np.where(rng.random(CHUNK) < 0.5, colors(rng, CHUNK), near)
    high = low + size * rng.choice([0.0, 1.0], p=[0.1, 0.9], size=(1, 3, CHUNK))
    low[:, 0] = np.maximum(low[:, 0], -60.0)
    high = np.maximum(low, high)
    return low, high, low + rng.random((1, 3, CHUNK)) * (high - low)


def colors(rng: Generator, count: int) -> FloatArray:
    """Everywhere, in the blue sector, or beside the neutral axis, shape (1, 3, n)."""
    lightness = rng.uniform(-16.0, 170.0, count)
    hue = np.radians(rng.uniform(0.0, 360.0, count))
    blue = np.radians(rng.uniform(215.0, 335.0, count))
    chroma = rng.uniform(0.0, 150.0, count)
    kind = rng.integers(0, 3, count)
    angle = np.where(kind == 1, blue, hue)
    chroma = np.where(kind == 2, rng.exponential(0.3, count), chroma)
    return np.array([[lightness, chroma * np.cos(angle), chroma * np.sin(angle)]])
