"""What a found paint is good for."""

from __future__ import annotations

from typing import Literal

from paintlink.model import Match, StartingPaint

Band = Literal["green", "amber", "red"]

GREEN_UP_TO = 1.5
AMBER_UP_TO = 3.0

BAND_LABELS: dict[Band, str] = {
    "green": "close starting point",
    "amber": "fair starting point",
    "red": "distant starting point",
}
"""Never "match": only the formulation software and a sprayed panel can tell that."""


def band(
    match: Match,
    *,
    green_up_to: float = GREEN_UP_TO,
    amber_up_to: float = AMBER_UP_TO,
) -> Band:
    """How good a starting point the paint is, by its mean difference per angle."""
    if match.mean <= green_up_to:
        return "green"
    return "amber" if match.mean <= amber_up_to else "red"


def starting_paint(match: Match) -> StartingPaint:
    """The paint as the formulation software needs it beside the target."""
    return StartingPaint(
        code=match.code,
        library=match.library,
        generation=match.generation,
        formula=match.formula,
        total=match.total,
        differences=match.differences,
    )
