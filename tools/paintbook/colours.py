"""Candidate paints with everything that decides whether they enter the library."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from paintlink.color import (
    LEAVES,
    chroma_index_array,
    flop_index_array,
    leaf_indices,
    reflectance_to_lab,
)
from paintlink.library.virtual import ANGLES_DEG, decoded, encoded
from paintlink.model import FloatArray
from paintlink_simulators.paint import WAVELENGTHS_NM, reflect
from paintlink_simulators.paint.base import of_flakes
from paintlink_simulators.paint.toners import FLAKE_COLUMNS

TRAVEL = [1, 3, 5]
"""Columns of 15, 45 and 110 degrees."""
MID = 3


@dataclass(frozen=True, slots=True, eq=False)
class Paints:
    """Many paints.

    Parameters
    ----------
    parts
        Shape (n, toners), sum 100.
    root
        Stored form of the reflectance factors, shape (n, 6, 31).
    lab
        Of the stored factors, in hundredths, shape (n, 6, 3).
    flop
        Flop index, shape (n,).
    leaf
        Index into `LEAVES`, shape (n,).
    """

    parts: FloatArray
    root: NDArray[np.uint16]
    lab: NDArray[np.int16]
    flop: FloatArray
    leaf: NDArray[np.int64]
    pearl: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.parts)

    def only(self, rows: NDArray[np.generic]) -> Paints:
        """Some of them."""
        return Paints(
            self.parts[rows],
            self.root[rows],
            self.lab[rows],
            self.flop[rows],
            self.leaf[rows],
            self.pearl[rows],
        )

    def travel(self) -> FloatArray:
        """Lab at 15, 45 and 110 degrees, shape (n, 3, 3)."""
        return self.lab[:, TRAVEL] / 100.0

    def chroma_index(self) -> FloatArray:
        """Chroma index of each."""
        return chroma_index_array(self.travel())


def paints(parts: FloatArray) -> Paints:
    """Spray and measure formulas; Lab comes from the factors as they are stored."""
    root = encoded(reflect(parts, ANGLES_DEG))
    lab = reflectance_to_lab(WAVELENGTHS_NM, decoded(root).reshape(-1, 31))
    hundredths = np.rint(100.0 * lab).astype(np.int16).reshape(len(parts), -1, 3)
    area = parts[:, FLAKE_COLUMNS] * of_flakes("area")[:, 0]
    solid = area.sum(axis=1) == 0.0
    pearl = area[:, 8:].sum(axis=1) >= 0.5 * area.sum(axis=1)
    kinds = np.where(solid, "solid", np.where(pearl, "pearl", "metallic"))
    mid = hundredths[:, MID] / 100.0
    return Paints(
        parts,
        root,
        hundredths,
        flop_index_array(hundredths[:, TRAVEL] / 100.0),
        leaf_indices(mid, kinds.tolist()),
        pearl & ~solid,
    )


def joined(*parts: Paints) -> Paints:
    """Several one after the other."""
    fields = ("parts", "root", "lab", "flop", "leaf", "pearl")
    return Paints(*(np.concatenate([getattr(p, f) for p in parts]) for f in fields))


def leaf_index(prefix: str) -> int:
    """Leaf of a code prefix such as ``RM``: family letter, then S or M."""
    families = "BGYRLMD"
    return families.index(prefix[0]) + (7 if prefix[1] == "M" else 0)


def prefix(leaf: int) -> str:
    """Code prefix of a leaf."""
    family = "BGYRLMD"[leaf % 7]
    return family + ("S" if LEAVES[leaf].paint_set == "solid" else "M")
