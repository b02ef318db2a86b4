"""Write the bundled stand-in library: 6000 invented paints, the same bytes every run.

Usage: ``python tools/make_standin_library.py [FILE]``. No real paint is in it. The
families it draws from are in standin_families.csv, the words of the names in
standin_words.txt, the optics in standin_optics.py.
"""

from __future__ import annotations

import csv
import io
import sys
import zipfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from standin_optics import (
    ANGLES_DEG,
    MID,
    Array,
    aspecular_curve,
    deal_flops,
    design,
    flop_index,
    most_vivid,
    polar,
)

HERE = Path(__file__).resolve().parent
TARGET = HERE.parent / "paintlink" / "library" / "data" / "standin.npz"
LIBRARY = "Stand-in 6000 (synthetic)"
SEED = 6000
GROUPS = "BGYRLMD"
NEUTRALS = "LMD"
SPACING = 0.3  # Lab units between any two solids, or effects, at 45 degrees

# The paints the paper names: Lab at 15, 45 and 110 that give the metrics it prints.
NAMED = {
    ("YM144", "Autumn Gold", "pearl"): (110, 2.6, 49.9, 60, 6, 38, 36, 14.2, 30.4),
    ("GM027", "Reef Jade", "pearl"): (86, -27.6, -11.7, 44, -20, 2, 27, -17.9, 13.9),
    ("GM044", "Meadow Fern", "pearl"): (84, -46.1, 41.5, 38, -24, 22, 14, -11, 11.6),
    ("BM304", "Harbour Blue", "metallic"): (118, -3, -20, 46, -2, -15, 18, -1, -14.6),
    ("RM209", "Ballad Ruby", "pearl"): (58, 68, 42, 30, 54, 35, 20.8, 34, 19),
    ("RM331", "Opera Garnet", "metallic"): (88, 41.6, 14, 36, 26, 6, 14, 15, 1.3),
}


class Family(NamedTuple):
    """Paints that hang side by side in a colour book: ranges of L, C and hue."""

    prefix: str
    paints: int
    low: Array
    high: Array
    flop: float
    pearl: float
    nouns: list[str]


class Paint(NamedTuple):
    """One row; ``lab`` at the six angles in hundredths, shape (6, 3)."""

    code: str
    name: str
    finish: str
    lab: NDArray[np.int16]


def main() -> None:
    """Write the library to the file named on the command line, or into the package."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET
    rng = np.random.Generator(np.random.PCG64(SEED))
    data = archive(columns(list(book(rng)), rng))
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(data)
    print(f"{target}: {len(data)} bytes")


def book(rng: np.random.Generator) -> Iterator[Paint]:
    """Yield every paint in the order of its stable id: leaf by leaf, page by page."""
    families = read_families()
    names = Names(rng)
    drawn = [*solids(families, names, rng), *effects(families, names, rng)]
    for kind in "SM":
        for group in GROUPS:
            leaf = [paint for paint in drawn if paint.code[:2] == group + kind]
            yield from numbered(sorted(leaf, key=place_in_leaf))


def read_families() -> list[Family]:
    """Every family of standin_families.csv."""
    with (HERE / "standin_families.csv").open(newline="") as file:
        return [read_family(row) for row in csv.DictReader(file)]


def read_family(row: dict[str, str]) -> Family:
    """One line of standin_families.csv; an underscore stands for a space in a noun."""
    low, high = (
        np.array([float(row[f"{axis}_{end}"]) for axis in ("L", "C", "hue")])
        for end in ("from", "to")
    )
    nouns = [noun.replace("_", " ") for noun in row["nouns"].split()]
    flop, pearl = float(row["flop"]), float(row["pearl"])
    return Family(row["prefix"], int(row["paints"]), low, high, flop, pearl, nouns)


class Names:
    """Hands out two-word names, each once."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._words = (HERE / "standin_words.txt").read_text().split()
        self._taken = {name for _, name, _ in NAMED}

    def take(self, nouns: list[str]) -> str:
        """A name that ends in one of the nouns."""
        while True:
            name = f"{self._pick(self._words)} {self._pick(nouns)}"
            if name not in self._taken:
                self._taken.add(name)
                return name

    def _pick(self, words: list[str]) -> str:
        return words[int(self._rng.random() * len(words))]


def solids(
    families: list[Family], names: Names, rng: np.random.Generator
) -> Iterator[Paint]:
    """Yield solids: the same Lab at every angle."""
    for family, lab in mids([f for f in families if f.prefix.endswith("S")], rng):
        rows = np.tile(hundredths(lab), (len(ANGLES_DEG), 1))
        yield Paint(family.prefix, names.take(family.nouns), "solid", rows)


def effects(
    families: list[Family], names: Names, rng: np.random.Generator
) -> Iterator[Paint]:
    """Yield metallic and pearl paints, the named ones first."""
    named = np.array(list(NAMED.values()), dtype=np.float64).reshape(-1, 3, 3)
    for label, lab in zip(NAMED, hundredths(aspecular_curve(named)), strict=True):
        yield Paint(*label, lab)
    drawn = list(mids([f for f in families if f.prefix.endswith("M")], rng))
    mid = np.array([lab for _, lab in drawn])
    pearl = np.array([rng.random() < family.pearl for family, _ in drawn])
    lean = np.array([family.flop for family, _ in drawn]) * np.where(pearl, 0.8, 1.05)
    taken = flop_index(named[:, 0, 0] - named[:, 2, 0], named[:, 1, 0])
    flops = deal_flops(mid, lean, taken, rng)
    curves = hundredths(aspecular_curve(design(mid, flops, pearl, rng)))
    for (family, _), is_pearl, lab in zip(drawn, pearl, curves, strict=True):
        finish = "pearl" if is_pearl else "metallic"
        yield Paint(family.prefix, names.take(family.nouns), finish, lab)


def mids(
    families: list[Family], rng: np.random.Generator
) -> Iterator[tuple[Family, Array]]:
    """Yield Lab at 45 degrees for every paint, no two of them close together."""
    kept = np.full((sum(family.paints for family in families), 3), np.inf)
    members = (family for family in families for _ in range(family.paints))
    for row, family in enumerate(members):
        lab = lacquer(family, rng)
        while np.any(np.abs(kept - lab).max(axis=1) < SPACING):
            lab = lacquer(family, rng)
        kept[row] = lab
        yield family, lab


def lacquer(family: Family, rng: np.random.Generator) -> Array:
    """Lab of a lacquer that can exist, more often from the middle of the ranges."""
    while True:
        share = rng.random((2, 3)).mean(axis=0)
        lightness, chroma, hue = family.low + (family.high - family.low) * share
        if chroma <= most_vivid(lightness, hue):
            return np.round([lightness, *polar(chroma, hue)], 2)


def hundredths(lab: Array) -> NDArray[np.int16]:
    """Lab as integers of 0.01."""
    return np.asarray(np.rint(lab * 100.0), dtype="<i2")


def place_in_leaf(paint: Paint) -> tuple[float, float]:
    """Sort key: by pages of ten degrees of hue, light before dark."""
    lightness, a, b = paint.lab[MID]
    hue = (np.degrees(np.arctan2(b, a)) - 340.0) % 360.0
    return (0.0 if paint.code[0] in NEUTRALS else hue // 10.0, -lightness)


def numbered(leaf: list[Paint]) -> Iterator[Paint]:
    """Yield the paints with their codes; the named ones keep theirs."""
    named = {paint.code: paint for paint in leaf if len(paint.code) > 2}
    drawn = iter([paint for paint in leaf if len(paint.code) == 2])
    for number in range(1, len(leaf) + 1):
        code = f"{leaf[0].code[:2]}{number:03d}"
        yield named[code] if code in named else next(drawn)._replace(code=code)


def columns(
    paints: list[Paint], rng: np.random.Generator
) -> Iterator[tuple[str, NDArray[np.generic]]]:
    """Yield the columns of the file, see `paintlink.library.store.load`."""
    codes, names, finishes, lab = zip(*paints, strict=True)
    usual = np.where(np.array(finishes) == "solid", 89.0, 92.0)
    gloss_gu = usual + 1.8 * rng.standard_normal(len(paints))
    yield "library", np.array(LIBRARY)
    yield "synthetic", np.array(True)
    yield "observer", np.array("10")
    yield "angles_deg", np.array(ANGLES_DEG)
    yield "ids", np.arange(1, len(paints) + 1, dtype="<i8")
    yield "codes", np.array(codes, dtype="S")
    yield "names", np.array(names, dtype="S")
    yield "finishes", np.array(finishes, dtype="S")
    yield "lab_hundredths", np.array(lab, dtype="<i2")
    yield "gloss_tenths_gu", np.rint(gloss_gu * 10.0).astype("<i2")


def archive(arrays: Iterable[tuple[str, NDArray[np.generic]]]) -> bytes:
    """An npz file, not compressed and without the time of day."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as file:
        for name, array in arrays:
            member = zipfile.ZipInfo(f"{name}.npy", (1980, 1, 1, 0, 0, 0))
            member.create_system = 3
            content = io.BytesIO()
            np.lib.format.write_array(content, array, allow_pickle=False)
            file.writestr(member, content.getvalue())
    return buffer.getvalue()


if __name__ == "__main__":
    main()
