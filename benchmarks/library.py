"""What browsing and filling a library of a million paints costs.

Run ``python benchmarks/library.py [PAINTS]``. Every time stands beside one that nothing
can beat, taken in the same run: compare the ratios, not the milliseconds.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np

from paintlink.library import Filter, parse_choices
from paintlink.library.columns import columns
from paintlink.library.facets import facet
from paintlink.model import PaintTable

PAINTS = 1_000_000
ANGLES = (15.0, 45.0, 110.0)
ROUNDS = 15
FINISHES = ("solid", "metallic", "pearl")


def main() -> None:
    """Print a table of times and ratios."""
    paints = int(sys.argv[1]) if len(sys.argv) > 1 else PAINTS
    print(f"{paints} paints")
    filters(invented(paints))


def invented(paints: int) -> PaintTable:
    """A library of paints that need not look like paints."""
    rng = np.random.default_rng(1)
    planes = rng.normal(0.0, 20.0, (len(ANGLES), 3, paints))
    planes[:, 0] = np.sort(rng.uniform(2.0, 120.0, (len(ANGLES), paints)), axis=0)[::-1]
    return PaintTable(
        library="invented",
        generation="1",
        synthetic=True,
        observer="10",
        ids=np.arange(paints),
        codes=tuple(f"C{i:07d}" for i in range(paints)),
        names=tuple(f"Paint number {i}" for i in range(paints)),
        finishes=tuple(FINISHES[i % 3] for i in range(paints)),  # type: ignore[misc]
        angles_deg=ANGLES,
        lab=planes.transpose(2, 0, 1),
        facets={"brand": facet([f"Brand {i % 80}" for i in range(paints)])},
    )


def filters(table: PaintTable) -> None:
    """Time filters, warm: derived columns are worked out once for each library."""
    known = columns(table)
    start = time.perf_counter()
    values = (known.flop, known.hue_shift, known.chroma, known.leaves, known.texts)
    print(f"{'columns, once':32s} best {time.perf_counter() - start:9.2f} s")
    base = timed(
        "one pass over three indices", lambda: sum(v.sum() for v in values[:3])
    )
    three = Filter(flop=(3.0, 10.0), hue_shift=(2.0, 30.0), chroma=(1.0, 40.0))
    for name, chosen in (
        ("one index", Filter(flop=(3.0, 10.0))),
        ("three indices", three),
        ("check boxes", Filter(finishes=("metallic", "pearl"))),
        ("brand", Filter(facets=parse_choices(["brand=brand 7"]))),
        ("text", Filter(text="r 12345")),
    ):
        timed(name, lambda chosen=chosen: chosen.apply(table), base)


def timed(name: str, work: Callable[[], object], base: float | None = None) -> float:
    """Run ``work`` some times, print the best time and the ratio, return it in s."""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    best, worst = min(times), max(times)
    ratio = best / (base or best)
    print(f"{name:32s} best {best * 1e3:9.2f} ms   worst {worst * 1e3:9.2f} ms", end="")
    print(f"   x {ratio:6.1f}")
    return best


if __name__ == "__main__":
    main()
