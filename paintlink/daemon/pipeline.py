"""What happens to a colour, as pure functions: no clock, no files, no journal."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from dataclasses import replace

from paintlink.color import normalise
from paintlink.config import RouteSettings, SnapSettings
from paintlink.model import (
    ColorSpec,
    Finish,
    Instrument,
    Match,
    Origin,
    PaintTable,
    Reading,
)
from paintlink.snap import nearest, starting_paint

FIRST_RETRY_S = 1.0
LAST_RETRY_S = 5.0  # a share that is back finds its files within ten seconds
LONGEST_TEXT = 500


def specify(reading: Reading, finish: Finish | None = None) -> ColorSpec:
    """The colour specification of a reading, under the name of its sample.

    The finish is the one declared with the reading unless another one is given.

    Characters that no XML file can carry are left out of what the instrument or the
    operator typed; the reading keeps them.
    """
    instrument = reading.instrument
    cleaned = replace(
        reading,
        instrument=Instrument(
            _plain(instrument.maker),
            _plain(instrument.model),
            _plain(instrument.serial),
            _plain(instrument.firmware),
        ),
    )
    return normalise(
        cleaned, name=_plain(reading.sample), finish=finish or reading.finish
    )


def _plain(text: str) -> str:
    kept = (c for c in text if unicodedata.category(c) not in {"Cc", "Cs", "Cn"})
    return "".join(kept)[:LONGEST_TEXT]


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
    """Seconds to wait after a number of failed attempts: doubling from 1 to 5."""
    return float(min(FIRST_RETRY_S * 2.0 ** min(attempts, 20), LAST_RETRY_S))
