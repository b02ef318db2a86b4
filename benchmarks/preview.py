"""Times of the preview's stages, as multiples of what this machine does anyway.

Run with `python benchmarks/preview.py`. Seconds differ from machine to machine; the
ratio to a matrix product and to a copy, measured in the same run, does much less.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec, Lab, Sample
from paintlink.preview import (
    backends,
    bake,
    basis,
    coat,
    environment,
    gl,
    render,
    to_png,
    with_caption,
)
from paintlink.preview import scene as scenes
from paintlink.preview.strips import Strips, split

SIZE = 512
ROUGHNESS = 0.002
SCENE = scenes.Scene("panel", "studio", SIZE, (ROUGHNESS,), None)
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


def best_s(work: Callable[[], object], repeats: int) -> float:
    """Shortest time of several runs."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def sgemm_gflops() -> float:
    """Billions of operations a second of a single-precision matrix product."""
    square = np.ones((1024, 1024), dtype=np.float32)
    return 2 * 1024**3 / best_s(lambda: square @ square, 10) / 1e9


def copy_gbps() -> float:
    """Billions of bytes a second read and written by a large copy."""
    block = np.ones(1 << 25, dtype=np.float32)
    target = np.empty_like(block)
    return 2 * block.nbytes / best_s(lambda: np.copyto(target, block), 10) / 1e9


def preparation() -> dict[str, float]:
    """Seconds of what is done once for a light, a paint or a scene."""
    light = environment.load("studio")
    bake.base_table(light)
    return {
        "bake base": best_s(lambda: bake.base_table(light), 3),
        "bake coat": best_s(lambda: coat.coat_table(light, ROUGHNESS), 3),
        "fit one paint": best_s(lambda: basis.coefficients([SILVER]), 30),
        "scene": best_s(lambda: fresh_bands(SCENE), 5),
    }


def fresh_bands(scene: scenes.Scene) -> None:
    """Prepare the scene anew."""
    scenes._band.cache_clear()  # noqa: SLF001
    for rows in scene.bands():
        scenes.band(scene, rows)


def drawing() -> dict[str, float]:
    """Seconds of one picture by each renderer."""
    inks = np.concatenate([basis.coefficients([SILVER])[0], np.ones((1, 3))])
    strips = Strips(inks[np.newaxis].astype(np.float32), split((-1, 1), 1, SIZE))
    times = {"draw cpu": best_s(lambda: backends.draw(SCENE, strips, "cpu"), 20)}
    try:
        print(gl.renderer())
    except PreviewError as error:
        print(f"no OpenGL: {error}")
        return times
    times["draw gl"] = best_s(lambda: backends.draw(SCENE, strips, "gl"), 20)
    return times


def output() -> dict[str, float]:
    """Seconds from a picture to a file."""
    picture = render([SILVER], size=SIZE, backend="cpu")
    return {
        "caption": best_s(lambda: with_caption(picture), 5),
        "png": best_s(lambda: to_png(picture), 5),
    }


def main() -> None:
    """Print the table."""
    gflops, gbps = sgemm_gflops(), copy_gbps()
    print(f"sgemm {gflops:.0f} GFLOPS, copy {gbps:.1f} GB/s; {SIZE} pixels square")
    print(f"{'stage':16}{'ms':>10}{'GFLOP of sgemm':>16}{'GB of copy':>12}")
    for stage, seconds in (preparation() | drawing() | output()).items():
        work, moved = seconds * gflops, seconds * gbps
        print(f"{stage:16}{seconds * 1e3:10.1f}{work:16.2f}{moved:12.3f}")


if __name__ == "__main__":
    main()
