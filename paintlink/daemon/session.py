"""One instrument on one open connection, from identification to readings."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from types import TracebackType
from typing import Any, Self

from paintlink.config import InstrumentSettings
from paintlink.daemon.averaging import average
from paintlink.daemon.database import utc_now
from paintlink.instrument import Link, Prompt, SerialSettings, load_driver
from paintlink.links import is_simulated_path, open_serial
from paintlink.model import (
    Calibration,
    CalibrationState,
    Instrument,
    Origin,
    Reading,
)


def never() -> bool:
    """Return False: nobody cancels."""
    return False


class Session:
    """An identified instrument, ready to be read.

    Parameters
    ----------
    cancelled
        Asked during long waits; True ends them with a `CancelledError`.
    now
        The clock readings are stamped with.

    Raises
    ------
    LinkError, WrongInstrumentError, InstrumentError
        When the port cannot be opened or something else answers.
    """

    def __init__(
        self,
        settings: InstrumentSettings,
        *,
        cancelled: Callable[[], bool] = never,
        now: Callable[[], datetime] = utc_now,
    ) -> None:
        module = load_driver(settings.driver)
        self._settings = settings
        self._now = now
        line = _line(settings, module.INFO.serial)
        self._stream = open_serial(settings.port, line)
        try:
            link = Link(self._stream, clock=time.monotonic, cancelled=cancelled)
            self._driver = module.create(link, settings.options)
            self.instrument = self._identify()
        except BaseException:
            self._stream.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stream.close()

    @property
    def origin(self) -> Origin:
        """Whether readings are real; over a pseudo-terminal they never are."""
        simulated = is_simulated_path(self._settings.port)
        return "simulated" if simulated else self._settings.origin

    def calibration(self) -> CalibrationState:
        """State of the white calibration as the instrument tells it."""
        return self._driver.calibration()

    def calibrate(self, prompt: Prompt) -> None:
        """Lead the operator through a white calibration."""
        self._driver.calibrate(prompt)

    def read(self, sample: str, prompt: Prompt) -> Reading:
        """One reading, stamped with the time it arrived.

        It is the mean of as many measurements as the settings ask for.
        """
        taken = [
            self._driver.measure(_counted(prompt, number, self._settings.readings))
            for number in range(1, self._settings.readings + 1)
        ]
        return Reading(
            measurement=average(taken),
            instrument=self.instrument,
            taken_at=self._now(),
            origin=self.origin,
            calibration=Calibration(self._driver.calibration()),
            sample=sample,
        )

    def _identify(self) -> Instrument:
        found = self._driver.identify()
        return found if found.serial else replace(found, serial=self._settings.serial)


def _line(settings: InstrumentSettings, usual: SerialSettings) -> SerialSettings:
    """The usual line of the driver with what the configuration says otherwise."""
    changes = {
        "baudrate": settings.baud,
        "bytesize": settings.bytesize,
        "parity": settings.parity[0].upper() if settings.parity else None,
        "stopbits": settings.stopbits,
    }
    given: dict[str, Any] = {
        name: value for name, value in changes.items() if value is not None
    }
    return replace(usual, **given)


def _counted(prompt: Prompt, number: int, count: int) -> Prompt:
    """A prompt that says which of several measurements it asks for."""
    if count == 1:
        return prompt
    return lambda text: prompt(f"reading {number} of {count}: {text}")
