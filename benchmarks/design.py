"""From a changed parameter to the pixels of the design, with warm caches.

Run with `python benchmarks/design.py`. Milliseconds differ from machine to machine; the
ratio to one plain preview of a finished specification, in the same run, does not much.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from paintlink.design import Design, from_library, make_step
from paintlink.errors import PreviewError
from paintlink.library import bundled
from paintlink.model import ColorSpec
from paintlink.preview import render
from paintlink.preview.picture import Backend

SIZES = (256, 512)
ROUNDS = 40
GOAL_MS = 30.0
CHAIN = (
    ("rotate-hue", {"angle_deg": -20.0}),
    ("exposure", {"stops": 0.2}),
    ("tint-highlight", {"color": (82.0, 12.0, 62.0), "amount": 0.2}),
    ("set-flop", {"L": 15.0}),
)


def main() -> None:
    """Print a table for each renderer and size."""
    design = Design("benchmark", from_library(bundled(), "BM336"))
    for name, values in CHAIN:
        design = design.apply(make_step(name, values))
    spec = design.spec
    (step_ms,) = medians_ms(lambda i: changed(design, i).spec)
    print(f"{len(CHAIN) + 1} steps and a specification: {step_ms:.2f} ms")
    for backend in ("cpu", "gl"):
        for size in SIZES:
            try:
                row(design, spec, size, backend)
            except PreviewError as error:
                print(f"{backend} {size}: {error}")


def row(design: Design, spec: ColorSpec, size: int, backend: Backend) -> None:
    """Print one line: the changed design beside a plain preview."""
    whole, plain = medians_ms(
        lambda i: render([changed(design, i).spec], size=size, backend=backend),
        lambda _: render([spec], size=size, backend=backend),
    )
    verdict = "within" if whole <= GOAL_MS else "over"
    print(
        f"{backend} {size} px: {whole:5.1f} ms, plain preview {plain:5.1f} ms, "
        f"ratio {whole / plain:.2f} ({verdict} {GOAL_MS:g} ms)"
    )


def changed(design: Design, i: int) -> Design:
    """The design with a travel never asked for before."""
    return design.apply(make_step("travel", {"factor": 0.5 + i / (2 * ROUNDS)}))


def medians_ms(*works: Callable[[int], object]) -> list[float]:
    """Median time of each, taken in turns so that load on the machine hits all alike.

    Two rounds before fill the caches.
    """
    times = [[timed_ms(work, i) for work in works] for i in range(-2, ROUNDS)]
    return [statistics.median(column) for column in zip(*times[2:], strict=True)]


def timed_ms(work: Callable[[int], object], i: int) -> float:
    """Time of one run."""
    start = time.perf_counter()
    work(i)
    return (time.perf_counter() - start) * 1e3


if __name__ == "__main__":
    main()
