"""The bundled library as formulation software knows it: by formula."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from paintlink.model import FloatArray, Observer
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.paint import Formula, amounts, book

STARTS = 3


class BundledBook:
    """Starting formulas from the bundled library; see `watch.Book`."""

    def starts(self, code: str, target: Target) -> Sequence[Formula]:
        """The formula of the paint, if it is one of ours, then the nearest to it.

        Three in all: one start alone gets stuck about one time in ten.
        """
        formulas = list(book().values())
        lab = _colours(tuple(target.aspecular_deg.tolist()), target.observer)
        away = target.mean_difference(lab)
        order = np.argsort(away, kind="stable")[:STARTS].tolist()
        named = [book()[code]] if code in book() else []
        near = [formulas[row] for row in order if formulas[row] not in named]
        return [*named, *near][:STARTS]


@lru_cache(maxsize=8)
def _colours(aspecular_deg: tuple[float, ...], observer: Observer) -> FloatArray:
    """Nominal Lab of every bundled paint, shape (n, angles, 3)."""
    angles = np.array(aspecular_deg)
    anything = Target(angles, np.zeros((angles.size, 3)), observer)
    return anything.predicted(amounts(list(book().values())))
