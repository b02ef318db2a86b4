"""One instrument on one open connection, from identification to readings."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from paintlink.config import InstrumentSettings
from paintlink.daemon.averaging import (
    EXTRA_READINGS,
    average,
    outlier,
    without_farthest,
)
from paintlink.daemon.captures import Recorder
from paintlink.daemon.database import utc_now
from paintlink.errors import (
    CancelledError,
    InstrumentError,
    LinkError,
    ProtocolError,
    WrongInstrumentError,
)
from paintlink.instrument import (
    ByteStream,
    Confirming,
    Driver,
    Link,
    Prompt,
    ReadingMemory,
    SerialSettings,
    UsbSettings,
    confirm,
    load_driver,
)
from paintlink.links import Verb, is_simulated_path, open_link
from paintlink.model import (
    Calibration,
    CalibrationState,
    Instrument,
    Measurement,
    Origin,
    Reading,
)

Opener = Callable[[str, SerialSettings, UsbSettings | None], ByteStream]


def never() -> bool:
    """Return False: nobody cancels."""
    return False


class Session:
    """An identified instrument, ready to be read.

    Parameters
    ----------
    port
        Where it is now; the address of the settings when left out.
    cancelled
        Asked during long waits; True ends them with a `CancelledError`.
    heard
        Called whenever bytes arrive.
    now
        The clock readings are stamped with.
    captures
        Folder for a capture of every byte of the session; None keeps none.
    opener
        Opens the port.

    Raises
    ------
    LinkError, WrongInstrumentError, InstrumentError
        When the port cannot be opened or something else answers.
    """

    def __init__(
        self,
        settings: InstrumentSettings,
        *,
        port: str = "",
        cancelled: Callable[[], bool] = never,
        heard: Callable[[], None] = lambda: None,
        now: Callable[[], datetime] = utc_now,
        captures: Path | None = None,
        opener: Opener = open_link,
    ) -> None:
        self._settings = settings
        self._now = now
        self.port = port or settings.port
        module = load_driver(settings.driver)
        line = _line(settings, module.INFO.serial)
        self._stream = opener(self.port, line, module.INFO.usb)
        self._recorder = Recorder(captures, settings, now=now, heard=heard)
        self._link = Link(
            self._stream,
            clock=time.monotonic,
            tap=self._recorder.tap,
            cancelled=cancelled,
        )
        try:
            self._driver = module.create(self._link, settings.options)
            self.instrument = self.identify()
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def origin(self) -> Origin:
        """Whether readings are real; a simulator's never are."""
        simulated = is_simulated_path(self.port)
        return "simulated" if simulated else self._settings.origin

    def identify(self) -> Instrument:
        """What the instrument says it is.

        Raises
        ------
        WrongInstrumentError
            Also when it tells another serial number than the settings.
        """
        found = self._captured("identify").identify()
        wanted = self._settings.serial
        if found.serial and wanted and found.serial != wanted:
            msg = (
                f"{self.port} holds the {found.model} with serial number "
                f"{found.serial}, not {wanted}: plug the right one in, or correct "
                f"`serial` of {self._settings.name}"
            )
            raise WrongInstrumentError(msg, code=found.serial)
        return replace(found, serial=found.serial or wanted)

    def watch(self, time_s: float) -> None:
        """Keep an eye on the line while nobody wants a reading."""
        self._link.watch(time_s)

    def calibration(self) -> CalibrationState:
        """State of the white calibration as the instrument tells it."""
        return self._captured("calibration").calibration()

    def calibrate(self, prompt: Prompt | Confirming) -> None:
        """Lead the operator through a white calibration."""
        self._captured("calibrate").calibrate(prompt)

    def read(
        self,
        sample: str,
        prompt: Prompt | Confirming,
        *,
        calibrated_at: datetime | None = None,
    ) -> Reading:
        """One reading, stamped with the time it arrived.

        It is the mean of as many measurements as the settings ask for. Where these
        disagree, up to two more are taken and the farthest are left out.
        """
        taken = [
            self._measure(_counted(prompt, number, self._settings.readings))
            for number in range(1, self._settings.readings + 1)
        ]
        for _ in range(EXTRA_READINGS):
            if not (why := outlier(taken)):
                break
            again = self._measure(_explained(prompt, f"{why}: take one more. "))
            taken = without_farthest([*taken, again])
        return self._reading(average(taken), sample, calibrated_at)

    def stored(self) -> Iterator[Reading]:
        """The readings the instrument keeps; they stay there.

        Raises
        ------
        InstrumentError
            When it keeps none.
        """
        for measurement in self._memory("stored").stored():
            sample = f"{self._settings.name} {measurement.record}"
            yield self._reading(measurement, sample, None, ask=False)

    def clear(self) -> None:
        """Delete the readings the instrument keeps."""
        self._memory("clear").clear()

    def close(self) -> None:
        """Give the port back; never fails."""
        self._stream.close()
        self._recorder.close()

    def _memory(self, verb: Verb) -> ReadingMemory:
        driver = self._captured(verb)
        if not isinstance(driver, ReadingMemory):
            msg = f"{self.instrument.model} keeps no readings: measure with it instead"
            raise InstrumentError(msg)
        return driver

    def _measure(self, prompt: Prompt) -> Measurement:
        return self._captured("measure").measure(prompt)

    def _reading(
        self,
        measurement: Measurement,
        sample: str,
        calibrated_at: datetime | None,
        *,
        ask: bool = True,
    ) -> Reading:
        return Reading(
            measurement=measurement,
            instrument=self.instrument,
            taken_at=self._now(),
            origin=self.origin,
            calibration=Calibration(self._state() if ask else "unknown", calibrated_at),
            sample=sample,
            finish=self._settings.finish,
        )

    def _state(self) -> CalibrationState:
        # The reading is whole: nothing that happens now may cost it.
        try:
            return self.calibration()
        except (LinkError, ProtocolError, InstrumentError, CancelledError):
            return "unknown"

    def _captured(self, verb: Verb) -> Driver:
        """The driver, once the capture knows what it is about to be asked."""
        if self._recorder.full and verb != "identify":
            self._recorder.start_anew()
            # A replay begins with a fresh driver: it has to learn the model as well.
            with suppress(InstrumentError):
                self.identify()
        self._recorder.call(verb)
        return self._driver


class _Prefixed:
    """A prompt that puts something in front of each sentence."""

    def __init__(self, prompt: Prompt | Confirming, prefix: str) -> None:
        self._prompt = prompt
        self._prefix = prefix

    def __call__(self, sentence: str) -> None:
        self._prompt(self._prefix + sentence)

    def confirm(self, sentence: str) -> None:
        confirm(self._prompt, self._prefix + sentence)


def _counted(prompt: Prompt | Confirming, number: int, count: int) -> Prompt:
    """A prompt that says which of several measurements it asks for."""
    return prompt if count == 1 else _Prefixed(prompt, f"reading {number} of {count}: ")


def _explained(prompt: Prompt | Confirming, why: str) -> Prompt:
    return _Prefixed(prompt, why)


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
