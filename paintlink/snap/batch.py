"""The nearest paints of thousands of targets."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from paintlink.color import Formula
from paintlink.model import FloatArray
from paintlink.snap.bounds import PRUNING
from paintlink.snap.conditions import Comparison
from paintlink.snap.grown import Mask
from paintlink.snap.index import Index
from paintlink.snap.scan import Ranked, total

TARGETS_AT_ONCE = 8
"""Screened together: few enough that the work stays in the processor's cache."""

BLOCK_TARGETS = 64
SCAN_UP_TO = 10_000
"""As many paints are screened faster one and all than by the tree."""

Single = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Question:
    """What is asked of every target.

    Parameters
    ----------
    allowed
        Paints of the stock that may be returned.
    """

    formula: Formula
    top: int
    allowed: Mask | None = None


def nearest_many(
    index: Index, targets: FloatArray, question: Question, *, workers: int = 2
) -> Iterator[Ranked]:
    """The nearest paints of each target in turn, the same as one by one.

    Parameters
    ----------
    targets
        Lab at the angles of the index, shape (targets, angles, 3).
    workers
        Threads; each target is searched by one.
    """
    answer = _Screen(index, question) if _screens(index, question) else None
    blocks = [
        targets[start : start + BLOCK_TARGETS]
        for start in range(0, len(targets), BLOCK_TARGETS)
    ]

    def _answer(block: FloatArray) -> list[Ranked]:
        if answer is not None:
            return list(answer.ranked(block))
        return [_one(index, target, question) for target in block]

    with ThreadPoolExecutor(workers) as pool:
        yield from chain.from_iterable(pool.map(_answer, blocks))


def _one(index: Index, target: FloatArray, question: Question) -> Ranked:
    comparison = Comparison(target, index.conditions.angles_deg, question.formula)
    return index.nearest(comparison, question.top, question.allowed)


def _screens(index: Index, question: Question) -> bool:
    return question.formula.id == "cie76" and len(index.stock) <= SCAN_UP_TO


class _Screen:
    """CIE76 for several targets at once: in 24 bits first, then the few near ones."""

    def __init__(self, index: Index, question: Question) -> None:
        allowed = question.allowed
        self._positions = np.arange(len(index.stock))
        if allowed is not None:
            self._positions = np.flatnonzero(allowed)
        self._planes = index.stock.planes[..., self._positions]
        self._ids = index.stock.ids[self._positions]
        self._single = self._planes.astype(np.float32)
        self._angles = np.array(index.conditions.angles_deg)[:, np.newaxis]
        self._question = question

    def ranked(self, targets: FloatArray) -> Iterator[Ranked]:
        """Lists for some targets (n, angles, 3)."""
        for start in range(0, len(targets), TARGETS_AT_ONCE):
            yield from self._some(targets[start : start + TARGETS_AT_ONCE])

    def _some(self, targets: FloatArray) -> Iterator[Ranked]:
        screened = _screened(self._single, targets.astype(np.float32))
        limit = np.full((len(targets), 1), np.inf)
        if screened.shape[1] > self._question.top:
            last = self._question.top - 1
            limit = np.partition(screened, last, axis=1)[:, last : last + 1]
        pruning = PRUNING["cie76"]
        reach = limit * (1.0 + 2.0 * pruning.relative) + 2.0 * pruning.absolute
        of, near = np.nonzero(screened <= reach)
        at_angles = self._question.formula(
            self._planes[..., near].transpose(0, 2, 1),
            targets[of].transpose(1, 0, 2),
            self._angles,
        )
        totals = total(at_angles)
        order = np.lexsort((self._ids[near], totals, of))
        ends = np.cumsum(np.bincount(of, minlength=len(targets)))
        for first, end in zip([0, *ends[:-1].tolist()], ends.tolist(), strict=True):
            kept = order[first : min(end, first + self._question.top)]
            positions = self._positions[near[kept]]
            yield Ranked(
                positions, totals[kept], at_angles[:, kept].T, screened.shape[1]
            )


def _screened(planes: Single, targets: Single) -> NDArray[Any]:
    """Totals in 24 bits, shape (targets, paints)."""
    shape = (len(targets), planes.shape[2])
    summed, squares, one = (
        np.zeros(shape, "f4"),
        np.empty(shape, "f4"),
        np.empty(shape, "f4"),
    )
    for angle, plane in enumerate(planes):
        squares.fill(0.0)
        for channel in range(3):
            np.subtract(plane[channel], targets[:, angle, channel, None], out=one)
            np.multiply(one, one, out=one)
            np.add(squares, one, out=squares)
        np.sqrt(squares, out=squares)
        np.add(summed, squares, out=summed)
    return summed
