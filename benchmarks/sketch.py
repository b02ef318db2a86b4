"""How fast, and with --accuracy how right, a paint is read out of a painting.

Run with `python benchmarks/sketch.py`. Times stand beside one decoding of the same
picture's sRGB, taken in the same run: compare the ratios. `--accuracy` fits hundreds of
known paints through real files and writes docs/sketch-accuracy.md.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from paintlink.sketch.fit import ANGLES_DEG, fit_painting  # noqa: E402
from paintlink.sketch.transfer import decode_srgb  # noqa: E402
from tests.sketch import trials  # noqa: E402
from tests.sketch.synthesis import (  # noqa: E402
    Paint,
    Setup,
    exposure_for,
    picture,
    quantised,
    sphere,
)

TARGET = ROOT / "docs" / "sketch-accuracy.md"
SIZE = 384
PAINTS = 200
SIZES = (512, 1024, 4096)
INTRODUCTION = f"""# How right styling by sketch is

Written by `python benchmarks/sketch.py --accuracy`. Known paints are drawn on a sphere
of {SIZE} x {SIZE} pixels (light 25 degrees off the view, upper left), damaged, saved
and read back. Numbers are CIEDE2000 at the aspecular angles, median / 90th percentile
over the paints, of the angles the fit calls measured. *local* is what a sketch gives;
the two fits of the paper, which have no defence against strokes, are there to compare.

Library paints are synthetic clamped quadratics inside sRGB. Noise is Gaussian, 2 % of
the encoded range; strokes are thick lines of random flat colour over 10 % of the
object. All pictures are synthetic: no artist has painted any of them.

Eight bits leave a dark flop a handful of codes, and a JPEG rounds the chroma of smooth
areas to whole codes; the fit takes that back by saving itself the same way.
"""


def main() -> None:
    """Print times, or write the table of errors."""
    if "--accuracy" in sys.argv[1:]:
        lines = [INTRODUCTION, *table()]
        TARGET.write_text("\n".join(lines) + "\n", encoding="utf-8")
    else:
        for size in SIZES:
            speed(size)


def speed(size: int) -> None:
    """Print the time of a fit with the geometry at hand."""
    setup = Setup.of(sphere(size))
    paint = trials.library_paints(1)[0]
    exposure = exposure_for(setup.geometry, paint.reflectance)
    painting = quantised(picture(setup.geometry, paint.reflectance, exposure), 8)
    decoding = best_s(lambda: decode_srgb(painting.encoded))
    fitting = best_s(
        lambda: fit_painting(painting, setup.geometry, setup.start, exposure=exposure)
    )
    print(
        f"{size:5d} x {size:<5d} fit {1e3 * fitting:6.0f} ms   decoding sRGB "
        f"{1e3 * decoding:6.0f} ms   x {fitting / decoding:5.2f}"
    )


def best_s(work: Callable[[], object], rounds: int = 3) -> float:
    """Shortest time of several runs."""
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def table() -> Iterator[str]:
    """Lines of the table, printed as they come."""
    setup = Setup.of(sphere(SIZE))
    angles = " | ".join(f"{angle:g}°" for angle in ANGLES_DEG)
    yield f"| paints | file | fit | {angles} | measured |"
    yield "|---|---|---|" + "---|" * (len(ANGLES_DEG) + 1)
    groups = {
        "library": trials.library_paints(PAINTS),
        "pearls": trials.pearl_paints(PAINTS // 4),
        "real curves": trials.real_paints(),
    }
    for name, paints in groups.items():
        for damage in (trials.EXACT, trials.PNG, trials.DAUBED, trials.JPEG):
            for line in rows(f"{name} ({len(paints)})", setup, paints, damage):
                print(line, flush=True)
                yield line


def rows(
    group: str, setup: Setup, paints: list[Paint], damage: trials.Damage
) -> Iterator[str]:
    """Lines for one group of paints through one kind of damage."""
    if not paints:
        return
    for name, errors in trials.trial(setup, paints, damage).items():
        cells = " | ".join(
            f"{median:.2f} / {p90:.2f}"
            for median, p90 in zip(errors.median, errors.p90, strict=True)
        )
        share = f"{100.0 * errors.measured:.1f} %"
        yield f"| {group} | {damage.name} | {name} | {cells} | {share} |"


if __name__ == "__main__":
    main()
