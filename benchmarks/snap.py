"""How long the nearest-paint search takes, beside what else could do it.

Run ``python benchmarks/snap.py [PAINTS ...]``, by default 6000, 100 000, 1 000 000 and
10 000 000; the last needs 6 GB of memory and some minutes. Times of single queries are
processor time of the one thread that searches, which other programs disturb little.
Every time stands beside others of the same run: compare the ratios, not the
milliseconds. Libraries beyond the
bundled 6000 paints are variants of them; targets are readings and designs, some out
of gamut. faiss and one pass over memory answer an easier question (see docs/snap.md).
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator

from paintlink.color import FORMULAS
from paintlink.library import bundled
from paintlink.model import FloatArray
from paintlink.snap import STANDARD_ANGLES_DEG
from paintlink.snap.batch import Question, nearest_many
from paintlink.snap.conditions import Comparison, Conditions
from paintlink.snap.index import FIRST_QUESTION, Index
from paintlink.snap.stock import Stock

SIZES = (6_000, 100_000, 1_000_000, 10_000_000)
TOP = 10
QUERIES = {"tree": 300, "ciede2000": 100, "scan": 30}
BATCH = 10_000
FACE_TO_FLOP = (np.array(STANDARD_ANGLES_DEG) - 45.0)[:, np.newaxis, np.newaxis] / 65.0


@dataclass(slots=True)
class Times:
    """What one engine took for each query, in seconds."""

    name: str
    seconds: list[float]
    note: str = ""

    @property
    def p50(self) -> float:
        """Median."""
        return float(np.median(self.seconds))

    @property
    def p99(self) -> float:
        """99th percentile; of few queries the largest."""
        return float(np.percentile(self.seconds, 99))


def main() -> None:
    """Print a table for each size."""
    sizes = tuple(int(text) for text in sys.argv[1:]) or SIZES
    rng = np.random.default_rng(1)
    for paints in sizes:
        planes = library(rng, paints)
        wanted = targets(rng, planes, max(QUERIES.values()))
        report(paints, [*others(planes, wanted), *ours(planes, wanted)])
        if paints == SIZES[0]:
            batch(planes)


def library(rng: Generator, paints: int) -> FloatArray:
    """Lab planes (3, 3, paints): the bundled paints, then variants of them."""
    table = bundled()
    columns = [table.angles_deg.index(angle) for angle in STANDARD_ANGLES_DEG]
    base = np.moveaxis(table.lab[:, columns], 0, 2)
    planes = np.empty((3, 3, paints))
    planes[..., : len(table)] = base[..., :paints]
    weights = 1.0 / (np.arange(len(table)) + 3.0) ** 0.8
    for first in range(len(table), paints, 500_000):
        count = min(500_000, paints - first)
        of = rng.choice(len(table), count, p=weights / weights.sum())
        spread = np.where(rng.random(count) < 0.25, 0.08, rng.gamma(2.0, 0.55, count))
        moved = rng.normal(0.0, 1.0, (1, 3, count)) * [[[0.8], [0.5], [0.7]]]
        tilt = rng.normal(0.0, 1.0, (1, 3, count)) * [[[0.7], [0.15], [0.2]]]
        noise = rng.gamma(2.0, 0.04, count) * rng.normal(0.0, 1.0, (3, 3, count))
        steps = spread * (moved - tilt * FACE_TO_FLOP) + noise
        planes[..., first : first + count] = np.round(base[..., of] + steps, 2)
    return planes


def targets(rng: Generator, planes: FloatArray, count: int) -> FloatArray:
    """Readings (60 %), new designs (25 %) and colours out of gamut, (n, 3, 3)."""
    paints = planes[..., rng.integers(0, planes.shape[2], count)].transpose(2, 0, 1)
    common, single = rng.normal(0.0, 0.7, (count, 1, 3)), rng.normal(0.0, 0.25, (3, 3))
    kind = rng.random(count)[:, np.newaxis, np.newaxis]
    reading = paints + rng.gamma(2.0, 0.4, (count, 1, 1)) * (common + single)
    design = paints + rng.normal(0.0, 6.0, (count, 1, 3))
    outside = paints * (1.15, 1.6, 1.6)
    outside[..., 0] += rng.normal(0.0, 10.0, (count, 1))
    outside[..., 0] = np.clip(outside[..., 0], 0.0, 170.0)
    chosen = np.where(kind < 0.6, reading, np.where(kind < 0.85, design, outside))
    return np.round(chosen, 3)


def ours(planes: FloatArray, wanted: FloatArray) -> list[Times]:
    """The search as it runs in a service that has been asked before."""
    count = planes.shape[2]
    numbers = np.arange(count)
    conditions = Conditions(STANDARD_ANGLES_DEG)
    index = Index("benchmark", "1", conditions, Stock(planes, numbers, numbers), None)
    found = []
    for formula, queries in (("cie76", "tree"), ("ciede2000", "ciede2000")):
        start = time.perf_counter()
        index.grown(FORMULAS[formula])
        built = time.perf_counter() - start
        index.searches = FIRST_QUESTION
        found.append(search(index, formula, wanted[: QUERIES[queries]]))
        if formula == "cie76":
            found[-1].note += f", tree built in {built:.2f} s"
    return found


def search(index: Index, formula: str, wanted: FloatArray) -> Times:
    """Our times, with the share of the paints that were compared."""
    compared: list[int] = []

    def _query(target: FloatArray) -> None:
        comparison = Comparison(target, STANDARD_ANGLES_DEG, FORMULAS[formula])
        compared.append(index.nearest(comparison, TOP).compared)

    times = timed(f"paintlink {formula}", _query, wanted)
    share = 100.0 * np.array(compared) / len(index.stock)
    times.note = f"compared {share.mean():.3f} % (most {share.max():.3f} %)"
    return times


def others(planes: FloatArray, wanted: FloatArray) -> list[Times]:
    """One pass over the numbers, faiss, and scipy's tree with the exact two-step."""
    some = wanted[: QUERIES["scan"]]
    single = planes.reshape(9, -1).astype(np.float32)
    found = [timed("one pass over memory", lambda _: single.max(), some)]
    points = np.ascontiguousarray(single.T)
    found += faiss_flat(points, wanted[: QUERIES["scan"]])
    found.append(two_step(points, wanted[: QUERIES["scan"] * 3]))
    return found


def faiss_flat(points: Any, wanted: FloatArray) -> list[Times]:
    """Nearest by Euclidean distance in nine dimensions, which is another measure."""
    try:
        import faiss
    except ImportError:
        print("faiss-cpu is not installed: pip install paintlink[bench]")
        return []
    faiss.omp_set_num_threads(1)
    flat = faiss.IndexFlatL2(points.shape[1])
    flat.add(points)
    return [
        timed(
            "faiss IndexFlatL2",
            lambda target: flat.search(target.reshape(1, 9).astype(np.float32), TOP),
            wanted,
        )
    ]


def two_step(points: Any, wanted: FloatArray) -> Times:
    """The sum is never below the distance: nearest 2k first, then a whole ball."""
    from scipy.spatial import cKDTree

    tree = cKDTree(points)

    def _sums(rows: Any, target: FloatArray) -> FloatArray:
        steps = points[rows].astype(np.float64).reshape(-1, 3, 3) - target
        summed: FloatArray = np.sqrt((steps * steps).sum(axis=2)).sum(axis=1)
        return summed

    def _query(target: FloatArray) -> None:
        flat = target.reshape(9)
        _, rows = tree.query(flat, 2 * TOP)
        limit = np.partition(_sums(rows, target), TOP - 1)[TOP - 1]
        near = np.array(tree.query_ball_point(flat, limit * (1.0 + 1e-9)))
        np.argsort(_sums(near, target))[:TOP]

    return timed("scipy cKDTree, two steps", _query, wanted)


def timed(name: str, work: Callable[[Any], object], wanted: FloatArray) -> Times:
    """Run ``work`` for each target, the first few times without the clock."""
    for target in wanted[:3]:
        work(target)
    seconds = []
    for target in wanted:
        start = time.thread_time()
        work(target)
        seconds.append(time.thread_time() - start)
    return Times(name, seconds)


def report(paints: int, rows: list[Times]) -> None:
    """Print the times of all engines at one size, faiss being 1."""
    base = next((one.p50 for one in rows if one.name.startswith("faiss")), rows[0].p50)
    print(
        f"\n{paints:,} paints, {TOP} nearest, three angles, one thread".replace(
            ",", " "
        )
    )
    for one in rows:
        print(
            f"  {one.name:26s} p50 {one.p50 * 1e3:8.3f} ms  p99 {one.p99 * 1e3:8.3f} ms"
            f"  {one.p50 / base:8.4f} x faiss  {one.note}"
        )


def batch(planes: FloatArray) -> None:
    """Print how many targets a second the batch mode finds paints for."""
    numbers = np.arange(planes.shape[2])
    stock = Stock(planes, numbers, numbers)
    index = Index("benchmark", "1", Conditions(STANDARD_ANGLES_DEG), stock, None)
    wanted = targets(np.random.default_rng(2), planes, BATCH)
    for workers in (1, 2):
        start, used = time.perf_counter(), time.process_time()
        question = Question(FORMULAS["cie76"], TOP)
        found = sum(1 for _ in nearest_many(index, wanted, question, workers=workers))
        rate = found / (time.perf_counter() - start)
        per_core = found / (time.process_time() - used)
        print(
            f"  batch of {found}, cie76, {workers} threads: {rate:.0f} targets/s, "
            f"{per_core:.0f} in a second of one processor"
        )


if __name__ == "__main__":
    main()
