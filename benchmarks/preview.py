"""Times of the preview's stages, as multiples of what this machine does anyway.

Run with `python benchmarks/preview.py`. Seconds differ from machine to machine; the
ratio to a matrix product and to a copy, measured in the same run, does much less. On a
machine that others use as well, the time of its processors tells more than the clock.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from statistics import median
from typing import NamedTuple
from unittest import mock

import numpy as np

from paintlink.errors import PreviewError
from paintlink.library import bundled
from paintlink.model import ColorSpec, Lab, Sample
from paintlink.preview import (
    Sheet,
    Turntable,
    bake,
    basis,
    coat,
    environment,
    fused,
    gl,
    render,
    to_png,
    turntable,
    with_caption,
)
from paintlink.preview import scene as scenes
from paintlink.preview.forms import form
from paintlink.preview.picture import Backend
from paintlink.preview.thumbnails import thumbnails

SIZE = 512
ROUGHNESS = 0.002
SILVER = ColorSpec(
    "silver blue",
    tuple(
        Sample(angle, Lab(*lab))
        for angle, lab in [
            (15, (105, -3, -12)),
            (45, (55, -2, -14)),
            (110, (26, -1, -12)),
        ]
    ),
)


class Times(NamedTuple):
    """Of several runs, in seconds.

    Parameters
    ----------
    processors_s
        Least time of all processors together, drivers' threads included.
    """

    best_s: float
    median_s: float
    processors_s: float


def timed(work: Callable[[], object], repeats: int) -> Times:
    """Times of several runs."""
    by_clock, by_processors = [], []
    for _ in range(repeats):
        start, busy = time.perf_counter(), time.process_time()
        work()
        by_clock.append(time.perf_counter() - start)
        by_processors.append(time.process_time() - busy)
    return Times(min(by_clock), median(by_clock), min(by_processors))


def best_s(work: Callable[[], object], repeats: int) -> float:
    """Shortest time of several runs."""
    return timed(work, repeats).best_s


def sgemm_gflops() -> float:
    """Billions of operations a second of a single-precision matrix product."""
    square = np.ones((1024, 1024), dtype=np.float32)
    return 2 * 1024**3 / best_s(lambda: square @ square, 10) / 1e9


def copy_gbps() -> float:
    """Billions of bytes a second read and written by a large copy."""
    block = np.ones(1 << 25, dtype=np.float32)
    target = np.empty_like(block)
    return 2 * block.nbytes / best_s(lambda: np.copyto(target, block), 10) / 1e9


def preparation() -> dict[str, Times]:
    """Seconds of what is done once for a light or a scene."""
    light = environment.load("studio")
    scene = scenes.Scene(form("panel"), light, SIZE, (ROUGHNESS,), None)
    return {
        "bake base": timed(lambda: bake.base_table(light), 2),
        "bake base, sky": timed(lambda: bake.base_table(environment.load("sky")), 2),
        "bake coat": timed(lambda: coat.coat_table(light, ROUGHNESS), 2),
        "prepare scene": timed(lambda: fresh_bands(scene), 3),
    }


def fresh_bands(scene: scenes.Scene) -> None:
    """Prepare the scene anew."""
    for kept in (scenes._band, scenes._light, scenes._surface):  # noqa: SLF001
        kept.cache_clear()
    for rows in scene.bands():
        scenes.band(scene, rows)


def drawing() -> dict[str, Times]:
    """Seconds of one preview, fit and all, by each renderer."""
    times = {"fit one paint": timed(lambda: basis.coefficients([SILVER]), 30)}
    for light in ("studio", "sky"):
        times[f"preview numpy, {light}"] = preview("cpu", light)
    try:
        print(gl.renderer())
    except PreviewError as error:
        print(f"no OpenGL: {error}")
        return times
    for light in ("studio", "sky"):
        times[f"preview OpenGL, {light}"] = preview("gl", light)
    return times


def preview(backend: Backend, light: str) -> Times:
    """Times of a picture of a paint in a prepared scene."""
    return timed(lambda: render([SILVER], light=light, size=SIZE, backend=backend), 30)


def many() -> dict[str, Times]:
    """Seconds of 6000 thumbnails, fit and all, and of one frame of a turn."""
    table = bundled()
    rows = np.arange(len(table))
    sheet = Sheet(cache_dir=None)
    compiled = fused.available()
    times = {}
    for name, offered in (("numpy", False), ("numba", compiled)):
        if name == "numba" and not compiled:
            continue
        with mock.patch.object(fused, "available", lambda offered=offered: offered):
            times[f"6000 thumbnails, {name}"] = timed(
                lambda: deque(thumbnails(table, rows, sheet), maxlen=0), 3
            )
    turning = Turntable(frames=2)
    disc = turntable.painted(SILVER, turning)
    frame = turntable.frame(turning, 0)
    times["turntable frame"] = timed(lambda: turntable.draw(frame, disc), 30)
    return times


def output() -> dict[str, Times]:
    """Seconds from a picture to a file."""
    picture = render([SILVER], size=SIZE, backend="cpu")
    return {
        "caption": timed(lambda: with_caption(picture), 5),
        "png": timed(lambda: to_png(picture), 5),
    }


def main() -> None:
    """Print the table."""
    gflops, gbps = sgemm_gflops(), copy_gbps()
    print(f"sgemm {gflops:.0f} GFLOPS, copy {gbps:.1f} GB/s; {SIZE} pixels square")
    print(
        f"{'':24}{'best':>10}{'median':>10}{'processors':>12}{'best, in terms of':>26}"
    )
    print(
        f"{'':24}{'ms':>10}{'ms':>10}{'ms':>12}{'GFLOP of sgemm':>16}{'GB of copy':>12}"
    )
    for stage, times in (preparation() | drawing() | many() | output()).items():
        best, middle, processors = (1e3 * seconds for seconds in times)
        work, moved = times.best_s * gflops, times.best_s * gbps
        print(f"{stage:24}{best:10.1f}{middle:10.1f}{processors:12.1f}", end="")
        print(f"{work:16.2f}{moved:12.3f}")


if __name__ == "__main__":
    main()
