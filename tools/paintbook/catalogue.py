"""The finished book: every paint with code, name, group and role, in order."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from paintbook.colours import MID, Paints, paints, prefix
from paintbook.groups import Group
from paintbook.names import Names
from paintlink.color import LEAVES, lab_to_lch
from paintlink.model import FloatArray
from paintlink_simulators.paint import amounts

NAMED = Path(__file__).resolve().parent / "named.csv"
PREFIXES = tuple(f"{family}{kind}" for kind in "SM" for family in "BGYRLMD")


class Entry(NamedTuple):
    """One line of the book; ``row`` of the paints, ``prime`` the code of its prime."""

    code: str
    name: str
    role: int
    prime: str
    row: int


def named() -> tuple[list[tuple[str, str]], Paints]:
    """Codes and names the paper prints, and their paints.

    The formulas of `named.csv` were found once by a search for the metrics that the
    paper prints; the test of the library pins that they have them.
    """
    with NAMED.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    formulas = [
        {
            code: float(parts)
            for code, parts in zip(words[::2], words[1::2], strict=True)
        }
        for words in (row["formula"].split() for row in rows)
    ]
    labels = [(row["code"], row["name"]) for row in rows]
    return labels, paints(amounts(formulas))


def entries(
    everything: Paints,
    groups: list[Group],
    labels: dict[int, tuple[str, str]],
    rng: np.random.Generator,
) -> Iterator[Entry]:
    """Every paint, leaf by leaf, hue by hue; groups stand together.

    Parameters
    ----------
    labels
        Code and name of the primes that the paper names, by row.
    """
    names = Names(rng, {name for _, name in labels.values()})
    mid = everything.lab[:, MID] / 100.0
    for leaf in range(len(LEAVES)):
        inside = [group for group in groups if everything.leaf[group.prime] == leaf]
        inside.sort(key=lambda group: _place(mid[group.prime], leaf))
        codes = _codes(prefix(leaf), {code for code, _ in labels.values()})
        block: list[Entry] = []
        for group in inside:
            given = labels.get(group.prime)
            name = given[1] if given else names.take(prefix(leaf), mid[group.prime])
            first = given[0] if given else next(codes)
            for number, (role, row) in enumerate(group.members()):
                code = next(codes) if number else first
                full = f"{name} V{number}" if number else name
                block.append(Entry(code, full, role, first, row))
        yield from sorted(block)


def _codes(start: str, taken: set[str]) -> Iterator[str]:
    for number in range(1, 1000):
        if (code := f"{start}{number:03d}") not in taken:
            yield code


def _place(mid: FloatArray, leaf: int) -> tuple[float, float]:
    """Chromatic leaves run round the hue circle, neutral ones from light to dark."""
    lightness, _, hue = np.nan_to_num(lab_to_lch(mid)).tolist()
    if LEAVES[leaf].chromatic:
        return ((hue + 20.0) % 360.0 // 3.0, -lightness)
    return (-lightness, hue)
