"""Filters and hierarchy against a plain reading of their definitions."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from paintlink.color import LEAVES, Leaf
from paintlink.library import Filter, leaves
from paintlink.library.facets import FacetChoice, facet
from paintlink.model import PaintTable

FILTERS = 1000
PAINTS = 400
ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)
WORDS = ("Ruby", "Straße", "İzmir", "blue", "GREY", "silver", "ﬁne", "2K", "red")
BRANDS = ("Alpha", "beta", "Gamma Ltd", "")
FINISHES = ("solid", "metallic", "pearl", "unknown")


def awkward_table(rng: random.Random) -> PaintTable:
    """Paints on both sides of every limit, some of them without an index."""
    lab = np.array([[_lab(rng) for _ in ANGLES] for _ in range(PAINTS)])
    lab[::7] = lab[::7, :1]  # no travel at all
    lab[3::31, 2, 0] = 0.0  # a flop index without a denominator
    lab[5::29, :, 1:] = 0.3  # an achromatic face
    return PaintTable(
        library="awkward",
        generation="1",
        synthetic=True,
        observer="10",
        ids=np.arange(PAINTS, dtype=np.int64),
        codes=tuple(f"{rng.choice(WORDS)}-{i}" for i in range(PAINTS)),
        names=tuple(f"{rng.choice(WORDS)} {rng.choice(WORDS)}" for _ in range(PAINTS)),
        finishes=tuple(rng.choice(FINISHES) for _ in range(PAINTS)),
        angles_deg=ANGLES,
        lab=lab,
        facets={
            "Brand": facet([rng.choice(BRANDS) for _ in range(PAINTS)]),
            "year": facet([rng.choice(("", "1999", "2020")) for _ in range(PAINTS)]),
        },
    )


def _lab(rng: random.Random) -> list[float]:
    reach = rng.choice((1.0, 7.0, 40.0))
    lightness = rng.choice((0.0, 35.0, 62.0, rng.uniform(0.0, 130.0)))
    return [lightness, rng.uniform(-reach, reach), rng.uniform(-reach, reach)]


def a_filter(rng: random.Random) -> Filter:
    def maybe(choices: object) -> object:
        return choices if rng.random() < 0.4 else None

    fragment = rng.choice(WORDS)[rng.randrange(2) :][: rng.randrange(1, 4)]
    return Filter(
        finishes=maybe(tuple(rng.sample(FINISHES, rng.randrange(1, 4)))) or (),
        leaves=maybe(tuple(rng.sample(LEAVES, rng.randrange(1, 9)))) or (),
        flop=maybe((rng.uniform(-1, 15), rng.uniform(0, 60))),
        hue_shift=maybe((rng.uniform(-1, 10), rng.uniform(0, 40))),
        chroma=maybe((rng.uniform(-1, 10), rng.uniform(0, 40))),
        text=maybe(rng.choice((fragment.upper(), fragment.lower(), "-1"))) or "",
        facets=maybe(_facets(rng)) or (),
    )


def _facets(rng: random.Random) -> tuple[FacetChoice, ...]:
    brand = FacetChoice("brand", tuple(rng.sample(("ALPHA", "Beta", "other"), 2)))
    year = FacetChoice("Year", (rng.choice(("2020", "1999..", "..2019.5", "1..5")),))
    return tuple(rng.sample((brand, year), rng.randrange(1, 3)))


def passes(table: PaintTable, row: int, chosen: Filter) -> bool:
    """The definitions, read one by one for one paint."""
    face, mid, flop = (table.lab[row, i].tolist() for i in (0, 2, 4))
    text = chosen.text.casefold()
    return (
        (not chosen.finishes or table.finishes[row] in chosen.finishes)
        and (not chosen.leaves or drawer(mid, table.finishes[row]) in chosen.leaves)
        and within(flop_of(face[0], mid[0], flop[0]), chosen.flop)
        and within(hue_shift_of(face, flop), chosen.hue_shift)
        and within(abs(chroma_of(face) - chroma_of(flop)), chosen.chroma)
        and (text in table.codes[row].casefold() or text in table.names[row].casefold())
        and all(meets(table, row, one) for one in chosen.facets)
    )


def within(value: float | None, limits: tuple[float, float] | None) -> bool:
    if limits is None:
        return True
    return value is not None and limits[0] <= value <= limits[1]


def flop_of(l15: float, l45: float, l110: float) -> float | None:
    if l15 <= l110:
        return 0.0
    return 2.69 * (l15 - l110) ** 1.11 / l45**0.86 if l45 > 0.0 else None


def chroma_of(lab: list[float]) -> float:
    return math.sqrt(lab[1] ** 2 + lab[2] ** 2)


def hue_shift_of(face: list[float], flop: list[float]) -> float | None:
    if chroma_of(face) < 1.0:
        return None
    return abs(flop[1] * face[2] - face[1] * flop[2]) / chroma_of(face)


def drawer(lab: list[float], finish: str) -> Leaf | None:
    if finish == "unknown":
        return None
    paint_set = "solid" if finish == "solid" else "effect"
    if chroma_of(lab) < (8.0 if paint_set == "solid" else 6.0):
        value = "light" if lab[0] >= 62.0 else "medium" if lab[0] >= 35.0 else "dark"
        return Leaf(paint_set, value)
    hue = math.degrees(math.atan2(lab[2], lab[1])) % 360.0
    if 45.0 <= hue < 115.0:
        return Leaf(paint_set, "yellow")
    if 115.0 <= hue < 215.0:
        return Leaf(paint_set, "green")
    return Leaf(paint_set, "blue" if 215.0 <= hue < 340.0 else "red")


def meets(table: PaintTable, row: int, choice: FacetChoice) -> bool:
    name = next(one for one in table.facets if one.lower() == choice.column.lower())
    value = table.facets[name].value(row)
    for wanted in choice.values:
        low, sign, high = wanted.partition("..")
        if not sign:
            if value and value.lower() == wanted.lower():
                return True
        elif value and float(low or -1e9) <= float(value) <= float(high or 1e9):
            return True
    return False


def test_thousand_random_filters_equal_the_definitions() -> None:
    rng = random.Random(20260)
    found = wrong = 0
    for number in range(FILTERS):
        if number % 100 == 0:
            table = awkward_table(rng)
        chosen = a_filter(rng)

        mask = chosen.mask(table)

        expected = [passes(table, row, chosen) for row in range(PAINTS)]
        wrong += mask.tolist() != expected
        found += any(expected) and not all(expected)
    assert wrong == 0
    assert found > 0.6 * FILTERS  # most of them tell some paints from others


def test_drawers_equal_the_definitions() -> None:
    rng = random.Random(7)
    for _ in range(20):
        table = awkward_table(rng)

        found = [LEAVES[i] if i >= 0 else None for i in leaves(table)]

        mids = table.lab[:, 2].tolist()
        assert found == [
            drawer(mid, finish)
            for mid, finish in zip(mids, table.finishes, strict=True)
        ]


@pytest.mark.parametrize("finish", FINISHES)
def test_awkward_tables_hold_every_finish(finish: str) -> None:
    assert awkward_table(random.Random(1)).finishes.count(finish) > 50
