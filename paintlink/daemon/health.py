"""Whether every route moves: a stuck queue must not be silent."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime
from typing import Literal, NamedTuple

from paintlink.config import RouteSettings
from paintlink.daemon.journal import Journal

Light = Literal["green", "red"]

SILENCE_S = 4.0  # red within five seconds of a folder that hangs


class RouteHealth(NamedTuple):
    """State of one route; ``oldest_s`` is how long its oldest file has been waiting."""

    route: str
    light: Light
    waiting: int
    oldest_s: float
    note: str


def health(
    journal: Journal, routes: Sequence[RouteSettings], now: datetime
) -> tuple[RouteHealth, ...]:
    """Each route with what waits for it, those that are no longer configured too.

    Red is a route whose folder refused a file, or that has not written one for four
    seconds although one is waiting.
    """
    waiting = journal.deliveries.waiting()
    names = [*dict.fromkeys([one.name for one in routes] + list(waiting))]
    found = []
    for name in names:
        one = waiting.get(name)
        if one is None:
            found.append(RouteHealth(name, "green", 0, 0.0, ""))
            continue
        oldest_s = _age_s(one.since, now)
        last_s = _age_s(journal.deliveries.last_written_at(name), now)
        stuck = min(oldest_s, last_s) > SILENCE_S
        note = one.error or ("nothing gets through" if stuck else "")
        light: Light = "red" if one.error or stuck else "green"
        found.append(RouteHealth(name, light, one.number, oldest_s, note))
    return tuple(found)


def _age_s(moment: str, now: datetime) -> float:
    """Seconds since a time of the journal; for ever when there was none."""
    if not moment:
        return float("inf")
    return max(0.0, (now - datetime.fromisoformat(moment)).total_seconds())
