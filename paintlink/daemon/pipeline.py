"""What happens to a colour, as pure functions: no clock, no files, no journal."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from paintlink.color import normalise
from paintlink.config import RouteSettings, SnapSettings
from paintlink.model import ColorSpec, Finish, Match, Origin, PaintTable, Reading
from paintlink.snap import nearest, starting_paint

FIRST_RETRY_S = 1.0
LAST_RETRY_S = 300.0


def specify(reading: Reading, finish: Finish = "unknown") -> ColorSpec:
    """The colour specification of a reading, under the name of its sample."""
    return normalise(reading, name=reading.sample, finish=finish)


def match(
    spec: ColorSpec, table: PaintTable, settings: SnapSettings
) -> tuple[ColorSpec, tuple[Match, ...]]:
    """The specification with its starting paint, and the ranked list behind it."""
    matches = nearest(spec, table, top=settings.top, formula=settings.formula)
    return replace(spec, starting_paint=starting_paint(matches[0])), matches


def open_routes(routes: Iterable[RouteSettings], origin: Origin) -> list[RouteSettings]:
    """The routes that take readings of this origin.

    A simulated reading never enters a route that does not say that it accepts them.
    """
    return [route for route in routes if route.enabled and origin in route.accept]


def retry_delay_s(attempts: int) -> float:
    """Seconds to wait after a number of failed attempts: doubling from 1 to 300."""
    return float(min(FIRST_RETRY_S * 2.0 ** min(attempts, 20), LAST_RETRY_S))
