"""The distribution of flop indices that the paper prints."""

from __future__ import annotations

import numpy as np

from paintbook.colours import Paints
from paintbook.groups import BETWEEN_PAINTS, Group
from paintbook.shelf import Shelf
from paintlink.model import FloatArray

SHAPE, SCALE = 7.075, 1.6085
"""A gamma law of this shape has the paper's mean of 11.38 and 96.2 % below 20."""
MEAN = 11.38
USUAL = 20.0
CLOSE_ENOUGH = 0.0005


def quantiles(count: int) -> FloatArray:
    """So many flop indices that follow the law, ascending."""
    from scipy.stats import gamma

    shares = (np.arange(count) + 0.5) / count
    flops: FloatArray = gamma.ppf(shares, SHAPE, scale=SCALE)
    return flops


def lack(everything: Paints, groups: list[Group]) -> float:
    """What the flop indices lack, summed, to have the paper's mean."""
    members = [row for group in groups for _, row in group.members()]
    return float(len(members) * MEAN - everything.flop[members].sum())


def tuned(
    everything: Paints, groups: list[Group], shelf: Shelf, rng: np.random.Generator
) -> None:
    """Trade variants for spare ones of the same look until the mean is the paper's.

    Raises
    ------
    RuntimeError
        When the spare ones do not suffice.
    """
    missing = lack(everything, groups)
    close = CLOSE_ENOUGH * sum(1 for group in groups for _ in group.members())
    travel = everything.travel()
    for index in rng.permutation(len(groups)).tolist():
        for role, row in groups[index].spare:
            old = groups[index].variants.get(role, row)
            gain = everything.flop[row] - everything.flop[old]
            helps = 0.0 < gain * np.sign(missing) < abs(missing)
            usual = everything.flop[row] <= USUAL
            if helps and usual and shelf.room(travel[row], BETWEEN_PAINTS):
                groups[index].variants[role] = row
                shelf.put(travel[row])
                missing -= gain
        if abs(missing) < close:
            return
    msg = f"the flop indices still lack {missing:.1f} in the sum: draw more relatives"
    raise RuntimeError(msg)
