"""A formula, the answer that brings it, and the panel that was sprayed with it."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from datetime import datetime

from paintlink.errors import AnswerError
from paintlink.model import Observer, Origin, Sample

TOTAL_PARTS = 100.0
ROUNDING_PARTS = 0.05  # forty components rounded to 0.01 and some left


@dataclass(frozen=True, slots=True)
class Component:
    """One toner of a formula, in parts by mass."""

    toner: str
    parts: float
    added: bool = False


@dataclass(frozen=True, slots=True)
class Formula:
    """Toners and their parts, together 100.

    Raises
    ------
    AnswerError
        For a negative part, a toner that stands twice, or another total.
    """

    components: tuple[Component, ...]

    def __post_init__(self) -> None:
        for one in self.components:
            if not (math.isfinite(one.parts) and one.parts >= 0.0):
                msg = f"toner {one.toner} has {one.parts:g} parts; no mixture has that"
                raise AnswerError(msg)
        twice = [name for name, n in Counter(self.toners).items() if n > 1]
        if twice:
            msg = f"toner {twice[0]} stands twice; add its parts up"
            raise AnswerError(msg)
        total = math.fsum(one.parts for one in self.components)
        if abs(total - TOTAL_PARTS) > ROUNDING_PARTS:
            msg = f"the parts add up to {total:.2f}, not to 100: parts are missing"
            raise AnswerError(msg)

    @property
    def toners(self) -> tuple[str, ...]:
        """Codes of the toners, in the order of the formula."""
        return tuple(one.toner for one in self.components)


@dataclass(frozen=True, slots=True)
class Proposal:
    """A formula with the colour it is predicted to have.

    ``remaining_dE00`` is the mean CIEDE2000 to the target that the program stated.
    """

    formula: Formula
    predicted: tuple[Sample, ...]
    observer: Observer
    remaining_dE00: float


@dataclass(frozen=True, slots=True)
class Answer:
    """What formulation software wrote about a job: a proposal, or why there is none."""

    job: str
    iteration: int
    starting_paint: str
    proposal: Proposal | None
    refusal: str
    origin: Origin
    program: str
    created_at: datetime
    note: str = ""


@dataclass(frozen=True, slots=True)
class Panel:
    """A panel sprayed with a formula: what was predicted, and what was measured.

    ``iteration`` is that of the answer whose formula it was sprayed with.
    """

    iteration: int
    proposal: Proposal
    measured: tuple[Sample, ...]
