"""The colour a step starts from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from paintlink.design.weights import FACE_DEG, FLOP_DEG, MIDDLE_DEG
from paintlink.model import FloatArray, Observer


@dataclass(frozen=True, eq=False)
class State:
    """Lab D65 at the angles of a design.

    Parameters
    ----------
    angles_deg
        15, 45 and 110 aspecular degrees, or 15, 25, 45, 75 and 110.
    lab
        Shape (angles, 3); read-only.
    """

    angles_deg: tuple[float, ...]
    lab: FloatArray
    observer: Observer

    def __post_init__(self) -> None:
        self.lab.setflags(write=False)

    @cached_property
    def column(self) -> FloatArray:
        """The angles beside the Lab values, shape (angles, 1)."""
        return np.array(self.angles_deg)[:, np.newaxis]

    @property
    def face(self) -> FloatArray:
        """Lab at 15 degrees."""
        return self.at(FACE_DEG)

    @property
    def middle(self) -> FloatArray:
        """Lab at 45 degrees."""
        return self.at(MIDDLE_DEG)

    @property
    def flop(self) -> FloatArray:
        """Lab at 110 degrees."""
        return self.at(FLOP_DEG)

    def at(self, angle_deg: float) -> FloatArray:
        """Lab at one angle of the design, shape (3,)."""
        row: FloatArray = self.lab[self.angles_deg.index(angle_deg)]
        return row

    def moved(self, lab: FloatArray) -> State:
        """The same with other Lab values."""
        return replace(self, lab=lab)
