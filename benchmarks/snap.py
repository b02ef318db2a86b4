"""How long the nearest-paint search takes, beside what nothing can beat.

Run ``python benchmarks/snap.py``. Every time stands beside one pass over the same
numbers in memory, taken in the same run: compare the ratios, not the microseconds.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from paintlink.color import FORMULAS
from paintlink.library import bundled
from paintlink.model import ColorSpec, FloatArray, Lab, PaintTable, Sample
from paintlink.snap import STANDARD_ANGLES_DEG, nearest

ROUNDS = 300
ROUNDS_SLOW = 60


def main() -> None:
    """Print a table of times and ratios."""
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in STANDARD_ANGLES_DEG]
    numbers = np.ascontiguousarray(table.lab[:, columns])
    targets = readings(table, columns)
    base = timed("one pass over the numbers", lambda i: numbers.sum(), ROUNDS)
    timed("plain numpy brute force", lambda i: plain(numbers, targets[i]), ROUNDS, base)
    specs = [specification(target) for target in targets]
    for formula in FORMULAS:
        rounds = ROUNDS if formula == "cie76" else ROUNDS_SLOW
        for top in (1, 20):
            timed(
                f"nearest() {formula}, top {top}",
                lambda i, f=formula, k=top: nearest(specs[i], table, formula=f, top=k),
                rounds,
                base,
            )


def readings(table: PaintTable, columns: list[int]) -> list[FloatArray]:
    """Targets like readings: known paints, somewhat off."""
    rng = np.random.default_rng(1)
    rows = rng.integers(0, len(table), ROUNDS)
    return [table.lab[row, columns] + rng.normal(0.0, 0.7, (3, 3)) for row in rows]


def specification(lab: FloatArray) -> ColorSpec:
    """A target at the standard angles."""
    sides = zip(STANDARD_ANGLES_DEG, lab.tolist(), strict=True)
    samples = tuple(Sample(angle, Lab(*values)) for angle, values in sides)
    return ColorSpec(name="target", samples=samples)


def plain(numbers: FloatArray, target: FloatArray) -> int:
    """Row of the nearest paint, the short way."""
    return int(np.sqrt(((numbers - target) ** 2).sum(axis=2)).sum(axis=1).argmin())


def timed(
    name: str, work: Callable[[int], object], rounds: int, base: float | None = None
) -> float:
    """Run ``work`` for each target, print p50, p99 and the ratio, return p50 in s."""
    times = []
    for i in range(rounds):
        start = time.perf_counter()
        work(i)
        times.append(time.perf_counter() - start)
    p50, p99 = np.percentile(times, [50, 99])
    ratio = p50 / (base or p50)
    print(
        f"{name:32s} p50 {p50 * 1e6:7.0f} µs   p99 {p99 * 1e6:7.0f} µs   x {ratio:6.1f}"
    )
    return float(p50)


if __name__ == "__main__":
    main()
