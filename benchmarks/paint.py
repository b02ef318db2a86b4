"""How fast virtual paint is computed and the bundled library is loaded and made.

Run ``python benchmarks/paint.py``, on one core with ``OPENBLAS_NUM_THREADS=1``. The
ratios are stable, the rates are those of the machine.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
import time
import tracemalloc
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from paintlink.library import Book, bundled
from paintlink.library.store import BUNDLED, load
from paintlink.model import FloatArray
from paintlink_simulators.paint import TONERS, reflect

TOOL = Path(__file__).resolve().parents[1] / "tools" / "make_library.py"
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
    library()


def library() -> None:
    """Print what loading and making the bundled library costs."""
    unpacked = best(unpack)
    table, everything = best(lambda: load(BUNDLED)), best(lambda: Book(bundled()))
    print(f"loading the table: {1e3 * table:.0f} ms, {table / unpacked:.1f} x")
    print("  the time of unpacking its file")
    print(f"formulas, spectra and textures: {1e3 * everything:.0f} ms on first use")
    tracemalloc.start()
    kept = load(BUNDLED)
    print(
        f"{len(kept)} paints: {tracemalloc.get_traced_memory()[1] / 1e6:.1f} MB at most"
    )
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        subprocess.run([sys.executable, TOOL, f"{folder}/library.npz"], check=True)
        print(f"making it: {time.perf_counter() - start:.0f} s")


def unpack() -> int:
    """Unpack every column of the library's file."""
    with zipfile.ZipFile(io.BytesIO(BUNDLED.read_bytes())) as archive:
        return sum(len(archive.read(name)) for name in archive.namelist())


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
