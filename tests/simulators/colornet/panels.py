"""Virtual paints nobody has seen, and what an instrument reads from their panels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from paintlink.color import reflectance_to_lab
from paintlink.model import FloatArray
from paintlink_simulators.paint import (
    TONERS,
    WAVELENGTHS_NM,
    Formula,
    Panel,
    Repeatability,
    noisy,
    reflect,
)

ANGLES = np.array([15.0, 45.0, 110.0])
CODES = [toner.code for toner in TONERS]
CHROMATIC = [code for code in CODES if code[0] in "YORMVBG"]
ALUMINIUM = [code for code in CODES if code[0] == "A"]
PEARL = [code for code in CODES if code[0] == "P"]


def drawn(rng: np.random.Generator) -> Formula:
    """A formula as refinish books have them: a quarter solids, the rest with flakes."""
    parts = dict(_colours(rng))
    if rng.random() < 0.25:
        parts["W10"] = 10.0 ** rng.uniform(-0.3, 2.0)
    elif rng.random() < 0.42:
        parts[str(rng.choice(PEARL))] = 10.0 ** rng.uniform(0.5, 1.9)
        if rng.random() < 0.5:
            parts[str(rng.choice(ALUMINIUM))] = 10.0 ** rng.uniform(-0.3, 1.5)
    else:
        for code in rng.choice(ALUMINIUM, rng.integers(1, 3), replace=False):
            parts[str(code)] = 10.0 ** rng.uniform(0.5, 1.9)
    return parts


def _colours(rng: np.random.Generator) -> Iterator[tuple[str, float]]:
    for code in rng.choice(CHROMATIC, rng.integers(1, 4), replace=False):
        yield str(code), 10.0 ** rng.uniform(-0.3, 1.5)
    if rng.random() < 0.5:
        yield "N20", 10.0 ** rng.uniform(-1.0, 1.0)


class Book:
    """Known formulas with their nominal colours, as a paint library has them."""

    def __init__(self, size: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.formulas = [drawn(rng) for _ in range(size)]
        table = np.zeros((size, len(TONERS)))
        for row, one in zip(table, self.formulas, strict=True):
            for code, parts in one.items():
                row[CODES.index(code)] = parts
        factors = reflect(table, ANGLES).reshape(-1, WAVELENGTHS_NM.size)
        self.lab = reflectance_to_lab(WAVELENGTHS_NM, factors).reshape(size, -1, 3)

    def nearest(self, lab: FloatArray, number: int = 3) -> list[Formula]:
        distance = np.linalg.norm(self.lab - lab, axis=-1).sum(axis=-1)
        return [self.formulas[row] for row in np.argsort(distance)[:number]]


def read(panel: Panel, rng: np.random.Generator, noise: Repeatability) -> FloatArray:
    """Lab D65/10 of one reading, shape (3, 3)."""
    factors = noisy(panel, rng, noise).factors_at(ANGLES)
    return reflectance_to_lab(WAVELENGTHS_NM, factors)
