"""One instrument on one open connection, from identification to readings."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from paintlink.config import InstrumentSettings
from paintlink.daemon.averaging import average
from paintlink.daemon.database import utc_now
from paintlink.instrument import (
    Direction,
    Driver,
    Link,
    Prompt,
    SerialSettings,
    load_driver,
)
from paintlink.links import CaptureWriter, Verb, is_simulated_path, open_link
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
    captures
        Folder for a capture of every byte of the session; None keeps none.

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
        captures: Path | None = None,
    ) -> None:
        module = load_driver(settings.driver)
        self._settings = settings
        self._now = now
        line = _line(settings, module.INFO.serial)
        self._stream = open_link(settings.port, line, module.INFO.usb)
        self._capture: CaptureWriter | None = None
        try:
            if captures is not None:
                self._capture = _new_capture(captures, settings, now())
            tap = self._capture.tap if self._capture else no_tap
            link = Link(
                self._stream, clock=time.monotonic, tap=tap, cancelled=cancelled
            )
            self._driver = module.create(link, settings.options)
            self.instrument = self._identify()
        except BaseException:
            self._close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._close()

    @property
    def origin(self) -> Origin:
        """Whether readings are real; over a pseudo-terminal they never are."""
        simulated = is_simulated_path(self._settings.port)
        return "simulated" if simulated else self._settings.origin

    def calibration(self) -> CalibrationState:
        """State of the white calibration as the instrument tells it."""
        return self._captured("calibration").calibration()

    def calibrate(self, prompt: Prompt) -> None:
        """Lead the operator through a white calibration."""
        self._captured("calibrate").calibrate(prompt)

    def read(self, sample: str, prompt: Prompt) -> Reading:
        """One reading, stamped with the time it arrived.

        It is the mean of as many measurements as the settings ask for.
        """
        taken = [
            self._captured("measure").measure(
                _counted(prompt, number, self._settings.readings)
            )
            for number in range(1, self._settings.readings + 1)
        ]
        return Reading(
            measurement=average(taken),
            instrument=self.instrument,
            taken_at=self._now(),
            origin=self.origin,
            calibration=Calibration(self.calibration()),
            sample=sample,
        )

    def _identify(self) -> Instrument:
        found = self._captured("identify").identify()
        return found if found.serial else replace(found, serial=self._settings.serial)

    def _captured(self, verb: Verb) -> Driver:
        """The driver, once the capture knows what it is about to be asked."""
        if self._capture is not None:
            self._capture.call(verb)
        return self._driver

    def _close(self) -> None:
        self._stream.close()
        if self._capture is not None:
            self._capture.close()


def no_tap(direction: Direction, data: bytes) -> None:
    """Keep nothing of what goes over the link."""


def _new_capture(
    folder: Path, settings: InstrumentSettings, started_at: datetime
) -> CaptureWriter:
    folder.mkdir(parents=True, exist_ok=True)
    name = re.sub(r"[^A-Za-z0-9-]+", "_", settings.name).strip("_")
    return CaptureWriter(
        folder / f"{name}-{started_at:%Y%m%dT%H%M%S.%f}.jsonl",
        driver=settings.driver,
        options=settings.options,
        started_at=started_at,
    )


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
