"""Invented names: a word of the country and a noun for the colour."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from paintlink.color import lab_to_lch
from paintlink.model import FloatArray

HERE = Path(__file__).resolve().parent
AXES = ("L", "C", "hue")


class Names:
    """Hands out two-word names, each once.

    Parameters
    ----------
    taken
        Names that are not to be given again.
    """

    def __init__(self, rng: np.random.Generator, taken: set[str]) -> None:
        self._rng = rng
        self._taken = set(taken)
        self._words = (HERE / "words.txt").read_text("utf-8").split()
        with (HERE / "nouns.csv").open(newline="", encoding="utf-8") as file:
            self._rows = list(csv.DictReader(file))
        self._low, self._high = (
            np.array([
                [float(row[f"{axis}_{end}"]) for axis in AXES] for row in self._rows
            ])
            for end in ("from", "to")
        )

    def take(self, prefix: str, mid: FloatArray) -> str:
        """A name for a paint of this leaf with this Lab at 45 degrees."""
        nouns = self._nouns(prefix, mid)
        while True:
            noun = nouns[int(self._rng.random() * len(nouns))].replace("_", " ")
            name = f"{self._words[int(self._rng.random() * len(self._words))]} {noun}"
            if name not in self._taken:
                self._taken.add(name)
                return name

    def _nouns(self, prefix: str, mid: FloatArray) -> list[str]:
        """Nouns of the range the colour lies in, or nearest to."""
        lightness, chroma, hue = np.nan_to_num(lab_to_lch(mid)).tolist()
        turns = np.array([[lightness, chroma, hue + turn] for turn in (-360.0, 0.0)])
        outside = np.maximum(self._low - turns[:, np.newaxis], 0.0)
        outside = outside + np.maximum(turns[:, np.newaxis] - self._high, 0.0)
        # A degree of hue counts for as much as chroma makes of it.
        outside[..., 2] *= max(chroma, 1.0) * np.pi / 180.0
        far = outside.sum(axis=2).min(axis=0)
        far[[row["prefix"] != prefix for row in self._rows]] = np.inf
        return self._choice(far).split()

    def _choice(self, far: FloatArray) -> str:
        near: NDArray[np.intp] = np.flatnonzero(far <= far.min() + 1e-9)
        return self._rows[int(near[int(self._rng.random() * len(near))])]["nouns"]
