"""How long paintlink takes to refuse each hostile colour specification.

Usage: python benchmarks/spec_hostile.py. Prints the slowest documents, as a multiple of
the time an ordinary one takes in the same run, and what the process came to weigh.
"""

from __future__ import annotations

import contextlib
import resource
import time
from statistics import median

from paintlink.errors import SpecError
from paintlink.spec import read_spec
from tests.spec.corpus import COMPLETE, Case
from tests.spec.hostile import HOSTILE
from tests.spec.refused_shapes import SHAPES
from tests.spec.refused_values import VALUES

ROUNDS = 5
SHOWN = 12


def read_ms(data: bytes) -> float:
    """Median time one reading takes, refusal included."""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        with contextlib.suppress(SpecError):
            read_spec(data)
        times.append((time.perf_counter() - start) * 1e3)
    return median(times)


def peak_mib() -> float:
    """Largest resident size of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    """Print the table."""
    ordinary_ms = read_ms(COMPLETE.encode())
    before_mib = peak_mib()
    cases: list[Case] = VALUES + SHAPES + HOSTILE
    timed = sorted(((read_ms(case.data()), case) for case in cases), key=_time)
    print(f"ordinary document: {ordinary_ms:.2f} ms")
    for spent_ms, case in timed[: -SHOWN - 1 : -1]:
        print(f"{spent_ms:8.2f} ms  {spent_ms / ordinary_ms:6.0f} x  {case}")
    print(f"{len(cases)} documents, median {median(ms for ms, _ in timed):.2f} ms")
    print(f"largest resident size grew by {peak_mib() - before_mib:.0f} MiB")


def _time(timed: tuple[float, Case]) -> float:
    return timed[0]


if __name__ == "__main__":
    main()
