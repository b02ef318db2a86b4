"""Which colours the formulation stand-in can make: the truth, worked out offline."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np

from forecast.colours import ANGLES_DEG, colours, deformed, formulas
from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink_simulators.colornet import Target, formulate
from paintlink_simulators.paint import formula

STARTS = 4
MAKEABLE_DE00 = 1.0
SEED = 20_260


class Bench:
    """Known formulas to start from, found by their colour."""

    def __init__(self, parts: FloatArray, lab: FloatArray) -> None:
        self._parts, self._lab = parts, lab

    def residual(self, lab: FloatArray) -> float:
        """Mean CIEDE2000 of the best formula found for a colour (3, 3).

        The first that counts as makeable ends the search.
        """
        distance = np.linalg.norm(self._lab - lab, axis=2).sum(axis=1)
        nearest = np.argsort(distance, kind="stable")[:STARTS]
        target, best = Target(ANGLES_DEG, lab), np.inf
        for row in nearest:
            with suppress(InputError):  # a fit that ends without any pigment
                found = formulate(target, [formula(self._parts[row])])
                best = min(best, found.mean_difference)
            if best <= MAKEABLE_DE00:
                break
        return best


def asked(count: int) -> Iterator[tuple[str, FloatArray]]:
    """Unseen paints and designs in turn, as kind and colour (3, 3)."""
    rng = np.random.default_rng(SEED)
    paints = np.round(colours(formulas(count, SEED)), 2)
    for number, lab in enumerate(paints):
        design = np.round(deformed(lab, rng), 2)
        yield ("design", design) if number % 2 else ("paint", lab)


def label(path: Path, bench: Bench, count: int, part: tuple[int, int]) -> None:
    """Add missing labels to a file; may be stopped and started at any time.

    Parameters
    ----------
    part
        Which share of the colours: (0, 2) and (1, 2) are the halves.
    """
    done = 0
    if path.exists():
        done = sum(1 for _ in path.open(encoding="ascii"))
    which, shares = part
    mine = [one for n, one in enumerate(asked(count)) if n % shares == which]
    with path.open("a", encoding="ascii", newline="") as file:
        writer = csv.writer(file)
        for kind, lab in mine[done:]:
            values = [f"{value:.2f}" for value in lab.ravel()]
            writer.writerow([kind, f"{bench.residual(lab):.4f}", *values])
            file.flush()
