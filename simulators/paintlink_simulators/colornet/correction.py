"""Correcting a formula after panels were sprayed with it.

What the panels show is the systematic part, toners stronger or weaker than nominal,
mixed with what spraying leaves to chance. So the target is moved against the
difference found, but not by all of it, and never so far that the correction's own
prediction leaves the colour that was asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators.colornet.formulation import (
    Formulation,
    adjusted,
    formulate,
)
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.paint import Formula

FIRST_DAMPING = 0.7
LATER_DAMPING = 0.85
WORTH_A_TONER_DE00 = 0.15
MOST_OFF_DE00 = 4.0


@dataclass(frozen=True, slots=True, eq=False)
class Attempt:
    """A panel that was sprayed: its formula, what was predicted, what was measured.

    Both are Lab at the angles of the target, shape (m, 3).
    """

    parts: Formula
    predicted: FloatArray
    measured: FloatArray


def correct(target: Target, attempts: Sequence[Attempt]) -> Formulation:
    """The next formula to spray, continuing from the best panel so far.

    Its predicted colour is that of nominal toners; with the difference found on the
    panels it is expected at the target. Where a correction would leave the target by
    more than 4 the formula of the best panel is given again.
    """
    best = best_attempt(target, attempts)
    moved = replace(target, lab=target.lab - _expected_shift(attempts))
    found = adjusted(moved, best.parts)
    wider = formulate(moved, [best.parts])
    if found.mean_difference - wider.mean_difference > WORTH_A_TONER_DE00:
        found = wider
    if float(target.mean_difference(found.predicted)) > MOST_OFF_DE00:
        found = _again(target, best)
    return found


def best_attempt(target: Target, attempts: Sequence[Attempt]) -> Attempt:
    """The attempt whose panel came nearest to the target."""
    return min(attempts, key=lambda one: float(target.mean_difference(one.measured)))


def _expected_shift(attempts: Sequence[Attempt]) -> FloatArray:
    """What a panel is expected to differ from its prediction, shape (m, 3)."""
    found = np.array([one.measured - one.predicted for one in attempts])
    damping = FIRST_DAMPING if len(attempts) == 1 else LATER_DAMPING
    shift: FloatArray = damping * found.mean(axis=0)
    return shift


def _again(target: Target, best: Attempt) -> Formulation:
    difference = target.difference(best.predicted)
    return Formulation(best.parts, 0, (), best.predicted, difference)
