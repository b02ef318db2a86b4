"""What browsing and filling a library of a million paints costs.

Run ``python benchmarks/library.py [PAINTS]``. Every time stands beside one that nothing
can beat, taken in the same run: compare the ratios, not the milliseconds.
"""

from __future__ import annotations

import csv
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from paintlink.library import Filter, Shelf, parse_choices
from paintlink.library.columns import columns
from paintlink.library.csv_export import csv_lines
from paintlink.library.csv_file import read_csv
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
    with tempfile.TemporaryDirectory() as folder:
        imports(paints, Path(folder))


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
        lab=np.round(planes, 2).transpose(2, 0, 1),
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


def imports(paints: int, folder: Path) -> None:
    """Time an import beside the bare reading of the same file by the csv module."""
    path, shelf = folder / "paints.csv", Shelf(folder / "library.db")
    with path.open("w") as file:
        file.writelines(csv_lines(invented(paints)))
    base = once("csv module alone", paints, lambda: bare_reading(path))
    incoming = []
    once("read and check", paints, lambda: incoming.append(read_csv(path)), base)
    store = lambda: shelf.editor.import_paints("Large", incoming[0])  # noqa: E731
    once("store", paints, store, base)
    once("load", paints, lambda: shelf.table("Large"), base)
    once("one facet", paints, lambda: shelf.table("Large").facets["brand"], base)
    code = incoming[0].blocks[0].codes[0]
    rename = lambda: shelf.editor.rename_paint("Large", code, new_name="x")  # noqa: E731
    once("rename one paint", paints, rename, base)
    size = shelf.own.path.stat().st_size / 2**20
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"library.db {size:.0f} MiB, process at most {peak:.0f} MiB")


def bare_reading(path: Path) -> int:
    """Number of rows of a CSV file."""
    with path.open(newline="") as file:
        return sum(1 for _ in csv.reader(file))


def once(
    name: str, paints: int, work: Callable[[], object], base: float | None = None
) -> float:
    """Run ``work``, print its time, paints per second and the ratio, return it in s.

    The time of the processor is printed beside it: on a busy machine compare that.
    """
    start, busy = time.perf_counter(), time.process_time()
    work()
    wall, busy = time.perf_counter() - start, time.process_time() - busy
    print(
        f"{name:32s} {wall:9.2f} s {busy:9.2f} s busy {paints / wall:11,.0f}/s", end=""
    )
    print(f"   x {busy / (base or busy):6.1f}")
    return busy


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
