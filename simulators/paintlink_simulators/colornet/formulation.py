"""From a target and known formulas to a formula that matches.

Start from a known paint, fit the amounts of its toners, and add one or two others
where they cannot do it. The pigments of the starting formula are kept through the
first fit: it was chosen by somebody who knew the colour.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink_simulators.colornet.fitting import Columns, fitted, helpful
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.paint import Formula, amounts, formula
from paintlink_simulators.paint.toners import FLOP_CONTROL_COLUMN

GOOD_DE00 = 0.25
CLOSE_DE00 = 1.0
MOST_TONERS = 8
ROUNDS = 4
SMALLEST_SHARE = 3e-4
TOTAL_PARTS = 100.0
TRIED_AT_ONCE = 2
FIRST_SHARE = 0.005


@dataclass(frozen=True, slots=True, eq=False)
class Formulation:
    """A formula, and the colour it is predicted to have.

    Parameters
    ----------
    parts
        By toner code, the largest first, two decimals, together 100.
    start
        Which of the starting formulas it came from.
    added
        Toners that formula does not have.
    predicted
        Lab at the angles of the target, shape (m, 3), for toners of nominal strength.
    difference
        CIEDE2000 to the target at each angle, shape (m,).
    """

    parts: Formula
    start: int
    added: tuple[str, ...]
    predicted: FloatArray
    difference: FloatArray

    @property
    def mean_difference(self) -> float:
        """Mean CIEDE2000 to the target."""
        return float(self.difference.mean())


def formulate(target: Target, starts: Sequence[Formula]) -> Formulation:
    """The best formula found from the starting formulas, tried in turn.

    The first that comes nearer than 0.25 is taken. One start alone gets stuck about
    one time in ten.

    Raises
    ------
    InputError
        When there is no starting formula, or one names an unknown toner.
    """
    table = amounts(starts)
    best: Formulation | None = None
    for number, parts in enumerate(table):
        found = _rounded(target, _improved(target, parts), number, parts)
        if best is None or found.mean_difference < best.mean_difference:
            best = found
        if best.mean_difference < GOOD_DE00:
            break
    if best is None:
        msg = "there is no known formula to start from: name a paint of the library"
        raise InputError(msg)
    return best


def adjusted(target: Target, present: Formula) -> Formulation:
    """The present toners in the amounts that match best; none is added."""
    parts = amounts([present])[0]
    return _rounded(target, fitted(target, parts, _used(parts)), 0, parts)


def _improved(target: Target, start: FloatArray) -> FloatArray:
    parts = fitted(target, start, _used(start))
    score = _score(target, parts)
    for _ in range(ROUNDS):
        if score < GOOD_DE00:
            break
        tried = min(_with_another(target, parts), key=lambda one: one[0], default=None)
        if tried is None or tried[0] >= score:
            break
        score, parts = tried
    return parts


def _with_another(
    target: Target, parts: FloatArray
) -> Iterable[tuple[float, FloatArray]]:
    """Score and parts after fitting with each of the most helpful other toners."""
    kept = np.where(parts < SMALLEST_SHARE, 0.0, parts)
    # Flop control alone is no paint.
    parts = kept if kept[:FLOP_CONTROL_COLUMN].any() else parts
    columns = _used(parts)
    if columns.size >= MOST_TONERS:
        columns = np.sort(columns[np.argsort(-parts[columns])[: MOST_TONERS - 1]])
    gain = helpful(target, parts / parts.sum(), columns)
    for toner in np.argsort(-gain)[:TRIED_AT_ONCE]:
        if gain[toner] > 0.0:
            more = np.sort(np.append(columns, toner))
            begun = np.where(np.isin(np.arange(parts.size), columns), parts, 0.0)
            begun[toner] = FIRST_SHARE
            found = fitted(target, begun, more)
            yield _score(target, found), found


def _score(target: Target, parts: FloatArray) -> float:
    return float(target.mean_difference(target.predicted(parts))[0])


def _used(parts: FloatArray) -> Columns:
    return np.flatnonzero(parts > 0.0)


def _rounded(
    target: Target, parts: FloatArray, number: int, start: FloatArray
) -> Formulation:
    """The formula as a scale can weigh it, with its colour computed anew."""
    hundredths = np.rint(TOTAL_PARTS * 100.0 * parts / parts.sum()).astype(np.int64)
    main = np.argmax(parts[:FLOP_CONTROL_COLUMN])
    hundredths[main] = max(1, hundredths[main])
    hundredths[np.argmax(hundredths)] += int(TOTAL_PARTS * 100) - hundredths.sum()
    weighed = hundredths / 100.0
    lab = target.predicted(weighed)[0]
    found = formula(weighed)
    return Formulation(
        parts=found,
        start=number,
        added=tuple(code for code in found if code not in formula(start)),
        predicted=lab,
        difference=target.difference(lab),
    )
