"""One thread for each instrument: connect, calibrate, read, and always come back."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from paintlink.config import InstrumentSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import InstrumentState, InstrumentStatus
from paintlink.daemon.session import Session
from paintlink.errors import (
    CancelledError,
    InstrumentError,
    JournalError,
    LinkError,
    LinkTimeoutError,
    NeedsCalibrationError,
    ProtocolError,
    ReadingError,
)

log = logging.getLogger(__name__)

FIRST_RETRY_S = 0.5
LAST_RETRY_S = 2.0  # a replugged instrument is back within 3 s

NameSample = Callable[[str], str]


def default_sample(name: str) -> str:
    """A sample name nobody typed: the instrument and the local time."""
    return f"{name} {datetime.now().astimezone():%Y-%m-%d %H:%M:%S}"


class InstrumentWorker(threading.Thread):
    """Keeps one configured instrument connected and stores what it measures.

    A reading is in the journal before the operator is told that it was taken.

    Parameters
    ----------
    captures
        Folder for the captured sessions; None keeps none.
    wake_line
        Called after each stored reading.
    limit
        Readings to take before ending; None means until stopped.
    """

    def __init__(
        self,
        settings: InstrumentSettings,
        journal_path: Path,
        *,
        captures: Path | None = None,
        stop: threading.Event,
        wake_line: Callable[[], None],
        name_sample: NameSample = default_sample,
        limit: int | None = None,
    ) -> None:
        super().__init__(name=f"instrument {settings.name}", daemon=True)
        self._settings = settings
        self._journal_path = journal_path
        self._captures = captures
        self._stop_event = stop
        self._wake_line = wake_line
        self._name_sample = name_sample
        self._left = limit
        self._identity = ""
        self._delay_s = FIRST_RETRY_S

    def run(self) -> None:
        """Connect again for as long as nobody stops the service."""
        with Journal(self._journal_path) as journal:
            self._journal = journal
            while not self.finished:
                self._try()
                if not self.finished:
                    self._stop_event.wait(self._delay_s)
                    self._delay_s = min(self._delay_s * 2, LAST_RETRY_S)

    def _try(self) -> None:
        try:
            self._connected()
        except CancelledError:
            log.debug("%s: stopped while waiting", self._settings.name)
        except (LinkError, ProtocolError, InstrumentError) as error:
            self._report("lost" if self._identity else "absent", str(error))
        except JournalError:
            log.exception("%s: the journal cannot be trusted", self.name)
            self._stop_event.set()
        except Exception as error:
            log.exception("%s: a fault of the program", self.name)
            self._report("lost", f"a fault of the program: {error}")

    def _connected(self) -> None:
        self._report("opening", f"opening {self._settings.port}")
        with Session(
            self._settings, cancelled=self._stop_event.is_set, captures=self._captures
        ) as session:
            found = session.instrument
            self._identity = f"{found.maker} {found.model} {found.serial}".strip()
            self._delay_s = FIRST_RETRY_S
            while not self.finished:
                self._one(session)

    def _one(self, session: Session) -> None:
        sample = self._name_sample(self._settings.name)
        try:
            reading = session.read(sample, self._ask_to_press)
        except LinkTimeoutError as error:
            log.debug("%s: %s", self._settings.name, error)
        except NeedsCalibrationError as error:
            self._calibrate(session, str(error))
        except (ProtocolError, ReadingError) as error:
            self._report("ready", f"reading refused, take it again: {error}")
        else:
            token = self._journal.accept_reading(reading, source=self._settings.name)
            log.info("%s %s stored", token, sample)
            self._left = None if self._left is None else self._left - 1
            self._wake_line()

    def _calibrate(self, session: Session, why: str) -> None:
        self._report("needs calibration", why)
        try:
            session.calibrate(self._ask_for_plaque)
        except LinkTimeoutError as error:
            log.info("%s: calibration: %s", self._settings.name, error)

    @property
    def finished(self) -> bool:
        """Whether it was stopped, or took all the readings it was to take."""
        return self._stop_event.is_set() or self._left == 0

    def _ask_to_press(self, text: str) -> None:
        self._report("ready", text)

    def _ask_for_plaque(self, text: str) -> None:
        self._report("needs calibration", text)

    def _report(self, state: InstrumentState, text: str) -> None:
        log.info("%s: %s: %s", self._settings.name, state, text)
        status = InstrumentStatus(self._settings.name, state, text, self._identity)
        self._journal.set_instrument(status)
