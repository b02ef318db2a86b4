"""The calibration clock: how old a calibration is, and what follows from it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime

from paintlink.config import InstrumentSettings
from paintlink.daemon.bench import Bench
from paintlink.model import Instrument


def identity_of(settings: InstrumentSettings, found: Instrument) -> str:
    """What an instrument is remembered by: its serial number, else its given name."""
    return f"{found.maker} {found.model} {found.serial or f'({settings.name})'}"


@dataclass(frozen=True, slots=True)
class Due:
    """A calibration that is due: why, and whether readings have to wait for it."""

    text: str
    blocks: bool


class CalibrationClock:
    """The clock of one instrument; it runs on when the service does not.

    Parameters
    ----------
    now
        The present, as an aware time.
    """

    def __init__(
        self,
        bench: Bench,
        settings: InstrumentSettings,
        found: Instrument,
        now: Callable[[], datetime],
    ) -> None:
        self._bench = bench
        self._settings = settings
        self._identity = identity_of(settings, found)
        self._now = now

    @property
    def at(self) -> datetime | None:
        """When the instrument was calibrated last; None when that is not known."""
        return self._bench.last_calibration(self._identity)

    def due(self) -> Due | None:
        """Why a calibration is due now; None while the last one is good.

        A clock that went back, so that the calibration lies in the future, makes it
        due as well: its age is not known.
        """
        at, limit_h = self.at, self._settings.calibration_h
        if at is None:
            return self._due("no calibration is on record")
        age_h = (self._now() - at).total_seconds() / 3600.0
        if age_h < 0.0:
            return self._due(f"the last calibration, {at:%Y-%m-%d %H:%M}, is to come")
        if age_h <= limit_h:
            return None
        return self._due(f"calibrated {age_h:.1f} h ago, allowed are {limit_h:g} h")

    def calibrated(self, how: str) -> None:
        """Start the clock anew."""
        self._bench.calibrated(self._identity, how)

    def _due(self, why: str) -> Due:
        text = f"{why}: run `paintlink calibrate '{self._settings.name}'`"
        return Due(text, blocks=self._settings.calibration_policy == "block")
