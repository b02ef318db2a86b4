"""Write the bundled library: 6000 virtual paints, the same bytes every run.

Usage: ``python tools/make_library.py [FILE]``. Needs scipy. The paints are sprayed with
the virtual paint system of ``paintlink_simulators.paint``; no real paint is in it.
"""

from __future__ import annotations

import sys
from collections import Counter
from functools import partial
from pathlib import Path

import numpy as np
from paintbook import draw, flop_law, limits
from paintbook.archive import archive, columns
from paintbook.catalogue import Entry, entries, named
from paintbook.colours import Paints, joined, leaf_index, paints
from paintbook.groups import Allowed, Group, grown, sizes
from paintbook.primes import dealt
from paintbook.shelf import Shelf

from paintlink.model import FloatArray

TARGET = (
    Path(__file__).resolve().parents[1]
    / "paintlink" / "library" / "data" / "virtual.npz"
)  # fmt: skip
SEED = 6000
CANDIDATES = {"S": 60_000, "M": 70_000}
QUOTAS = {
    "BS": 650, "GS": 480, "YS": 520, "RS": 650, "LS": 270, "MS": 230, "DS": 200,
    "BM": 640, "GM": 380, "YM": 430, "RM": 520, "LM": 330, "MM": 400, "DM": 300,
}  # fmt: skip
"""Paints by leaf: 3000 solids and 3000 effects."""

Rng = np.random.Generator


def main() -> None:
    """Write the library to the file named on the command line, or into the package."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET
    rng = np.random.Generator(np.random.PCG64(SEED))
    book, everything = composed(rng)
    data = archive(columns(book, everything, rng))
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(data)
    print(f"{target}: {len(book)} paints, {len(data)} bytes")


def composed(rng: Rng) -> tuple[list[Entry], Paints]:
    """The whole book, and the paints its entries point to."""
    labels, printed = named()
    reddest = limits.chroma(printed)[[code for code, _ in labels].index("RM209")]
    presentable = partial(limits.presentable, reddest=reddest)
    none = printed.only(np.zeros(0, dtype=np.int64))
    pool = paints(draw.solids(CANDIDATES["S"], rng))
    solids, flat = half("S", none, pool.only(limits.sound(pool)), limits.sound, rng)
    pool = paints(draw.effects(CANDIDATES["M"], rng))
    effects, travelling = half(
        "M", printed, pool.only(presentable(pool)), presentable, rng
    )
    groups = flat + [group.moved(len(solids)) for group in travelling]
    everything = joined(solids, effects)
    named_rows = {len(solids) + row: label for row, label in enumerate(labels)}
    return list(entries(everything, groups, named_rows, rng)), everything


def half(
    kind: str, printed: Paints, pool: Paints, allowed: Allowed, rng: Rng
) -> tuple[Paints, list[Group]]:
    """All solids or all effects; the printed paints stand alone and come first."""
    shelf = Shelf(2 * sum(QUOTAS.values()))
    for travel in printed.travel():
        shelf.put(travel)
    quota = Counter({leaf_index(p): n for p, n in QUOTAS.items() if p[1] == kind})
    quota.subtract(printed.leaf.tolist())
    wanted = {leaf: sizes(paints_left, rng) for leaf, paints_left in quota.items()}
    leaves = [leaf for leaf, members in wanted.items() for _ in members]
    members = [size for leaf in wanted for size in wanted[leaf]]
    primes = joined(printed, dealt(pool, leaves, _flops(kind, leaves), shelf, rng))
    everything, groups = grown(
        primes, [1] * len(printed) + members, shelf, allowed, rng
    )
    quota.subtract(
        int(everything.leaf[row])
        for group in groups[len(printed) :]
        for _, row in group.members()
    )
    short = list(quota.elements())
    flops = _flops(kind, short)
    if kind == "M":
        flops += flop_law.lack(everything, groups) / len(short)
    single = dealt(pool, short, flops, shelf, rng)
    groups += [Group(len(everything) + row) for row in range(len(single))]
    everything = joined(everything, single)
    if kind == "M":
        flop_law.tuned(everything, groups, shelf, rng)
    return everything, groups


def _flops(kind: str, leaves: list[int]) -> FloatArray:
    return flop_law.quantiles(len(leaves)) if kind == "M" else np.zeros(len(leaves))


if __name__ == "__main__":
    main()
