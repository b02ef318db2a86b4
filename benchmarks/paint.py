"""How fast virtual paint is computed, beside a matrix product of the same size.

Run ``python benchmarks/paint.py``, on one core with ``OPENBLAS_NUM_THREADS=1``. The
ratios are stable, the rates are those of the machine.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators.paint import TONERS, reflect

ANGLES_DEG = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)
PAINTS = 20_000
ROUNDS = 7


def main() -> None:
    """Print rates and ratios."""
    parts = formulas()
    toners = np.random.default_rng(2).random((len(TONERS), len(ANGLES_DEG) * 31))
    product = best(lambda: parts @ toners)
    many = best(lambda: reflect(parts, ANGLES_DEG))
    one = best(lambda: reflect(parts[0], (15.0, 45.0, 110.0)), 300)
    print(f"{PAINTS} paints x 6 angles: {PAINTS / many:,.0f} paints/s")
    print(f"  one matrix product of amounts and spectra: {many / product:.0f} x that")
    print(f"one paint x 3 angles: {1e3 * one:.2f} ms")


def formulas() -> FloatArray:
    """Formulas of five toners."""
    rng = np.random.default_rng(1)
    taken = rng.random((PAINTS, len(TONERS))).argsort(axis=1) < 5
    parts = np.where(taken, 10.0 ** rng.uniform(-1.0, 2.0, taken.shape), 0.0)
    parts[:, 0] += 1.0
    return parts


def best(work: Callable[[], object], rounds: int = ROUNDS) -> float:
    """Shortest time of some rounds in seconds, after one that fills the tables."""
    work()
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


if __name__ == "__main__":
    main()
