"""Colours and designs to make steps on."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from paintlink.design import Applied, Design, Start, from_spec, make_step
from paintlink.model import ColorSpec, FloatArray, Lab, Sample

THREE = (15.0, 45.0, 110.0)
FIVE = (15.0, 25.0, 45.0, 75.0, 110.0)
RED = ((52.0, 58.0, 40.0), (34.0, 48.0, 30.0), (20.0, 34.0, 20.0))
RED_AT_FIVE = (
    (52.0, 58.0, 40.0),
    (45.1849, 54.0, 36.0),
    (34.0, 48.0, 30.0),
    (23.336, 40.0, 24.0),
    (20.0, 34.0, 20.0),
)


def make_spec(lab: ArrayLike, name: str = "paint") -> ColorSpec:
    """A specification of Lab, shape (3, 3) or (5, 3)."""
    rows = np.asarray(lab, dtype=np.float64).tolist()
    angles = THREE if len(rows) == 3 else FIVE
    samples = (
        Sample(angle, Lab(*row)) for angle, row in zip(angles, rows, strict=True)
    )
    return ColorSpec(name=name, samples=tuple(samples), finish="metallic")


def make_start(lab: ArrayLike = RED) -> Start:
    return from_spec(make_spec(lab), "a test")


def make_design(lab: ArrayLike = RED) -> Design:
    return Design("designed", make_start(lab))


def applied(name: str, lab: ArrayLike = RED, **values: object) -> Applied:
    """One step on a colour."""
    return make_step(name, values).applied(make_start(lab).state)


def after(name: str, lab: ArrayLike = RED, **values: object) -> FloatArray:
    """Lab after one step."""
    return applied(name, lab, **values).state.lab
