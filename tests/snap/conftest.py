"""Libraries and targets made up for one test."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from paintlink.model import ColorSpec, Finish, Lab, Observer, PaintTable, Sample

STANDARD = (15.0, 45.0, 110.0)
SIX = (-15.0, 15.0, 25.0, 45.0, 75.0, 110.0)


def make_table(
    lab: ArrayLike,
    *,
    ids: Sequence[int] | None = None,
    angles_deg: tuple[float, ...] = STANDARD,
    observer: Observer = "10",
) -> PaintTable:
    """A library of metallics with Lab of shape (n, angles, 3)."""
    lab = np.asarray(lab, dtype=np.float64)
    finishes: tuple[Finish, ...] = ("metallic",) * len(lab)
    return PaintTable(
        library="Test book",
        generation="gen-1",
        synthetic=False,
        observer=observer,
        ids=np.arange(1, len(lab) + 1) if ids is None else np.array(ids),
        codes=tuple(f"C{row}" for row in range(len(lab))),
        names=tuple(f"Name {row}" for row in range(len(lab))),
        finishes=finishes,
        angles_deg=angles_deg,
        lab=lab,
    )


def make_target(
    lab: ArrayLike,
    *,
    angles_deg: tuple[float, ...] = STANDARD,
    observer: Observer = "10",
) -> ColorSpec:
    """A target with Lab of shape (angles, 3)."""
    rows = np.asarray(lab, dtype=np.float64).tolist()
    samples = (
        Sample(angle, Lab(*row)) for angle, row in zip(angles_deg, rows, strict=True)
    )
    return ColorSpec(name="target", samples=tuple(samples), observer=observer)
