"""One thread for each instrument: connect, calibrate, read, and always come back."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from paintlink.config import InstrumentSettings
from paintlink.daemon.calibration import CalibrationClock, identity_of
from paintlink.daemon.database import utc_now
from paintlink.daemon.finding import connect
from paintlink.daemon.journal import Journal
from paintlink.daemon.loans import Loan
from paintlink.daemon.patience import Patience
from paintlink.daemon.records import InstrumentState, InstrumentStatus
from paintlink.daemon.session import Opener, Session
from paintlink.errors import (
    CancelledError,
    InstrumentError,
    JournalError,
    JournalFullError,
    LinkError,
    LinkTimeoutError,
    NeedsCalibrationError,
    ProtocolError,
    ReadingError,
    WrongInstrumentError,
)
from paintlink.links import open_link
from paintlink.model import Calibration, Reading

log = logging.getLogger(__name__)

WATCH_S = 0.5
LOOK_S = 0.1
# What a disturbed line may spoil before it is opened anew.
MOST_REFUSALS = 3

NameSample = Callable[[str], str]
Ready = Callable[[str], bool]


def default_sample(name: str) -> str:
    """A sample name nobody typed: the instrument and the local time."""
    return f"{name} {datetime.now().astimezone():%Y-%m-%d %H:%M:%S}"


class InstrumentWorker(threading.Thread):
    """Keeps one configured instrument connected and stores what it measures.

    A reading is in the journal before the operator is told that it was taken.

    Parameters
    ----------
    state_folder
        Where the journal's folder keeps the locks by which a command borrows it.
    captures
        Folder for the captured sessions; None keeps none.
    wake_line
        Called after each stored reading.
    limit
        Readings to take before ending; None means until stopped.
    is_ready
        Asked, where the host starts a reading, whether the operator is ready. Nobody
        is when left out: such readings are asked for by `paintlink measure`.
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
        is_ready: Ready = lambda _sentence: False,
        now: Callable[[], datetime] = utc_now,
        opener: Opener = open_link,
    ) -> None:
        super().__init__(name=f"instrument {settings.name}", daemon=True)
        self._settings = settings
        self._journal_path = journal_path
        self._captures = captures
        self._stop_event = stop
        self._wake_line = wake_line
        self._name_sample = name_sample
        self._left = limit
        self._is_ready = is_ready
        self._now = now
        self._opener = opener
        self._identity = ""
        self._told: tuple[str, str] = ("", "")
        self._awaiting = False
        self._transferring = False
        self._refusals = 0
        self._patience = Patience(settings.port)

    def wake(self) -> None:
        """Try again now: a device may have come."""
        self._patience.wake()

    def run(self) -> None:
        """Connect again for as long as nobody stops the service."""
        with Journal(self._journal_path) as journal:
            self._journal = journal
            self._loan = Loan(self._journal_path.parent, self._settings.name)
            try:
                while not self.finished:
                    self._turn()
            finally:
                self._loan.close()

    @property
    def finished(self) -> bool:
        """Whether it was stopped, or took all the readings it was to take."""
        return self._stop_event.is_set() or self._left == 0

    def _turn(self) -> None:
        if not self._loan.hold():
            self._report("opening", "lent to a paintlink command")
            self._stop_event.wait(LOOK_S)
            return
        self._try()
        self._loan.release()
        if not (self.finished or self._loan.wanted()):
            self._patience.wait(self._stop_event)

    def _try(self) -> None:
        try:
            self._connected()
        except CancelledError:
            log.debug("%s: stopped while waiting", self._settings.name)
        except (LinkError, ProtocolError, InstrumentError) as error:
            self._report("lost" if self._identity else "absent", str(error))
        except JournalFullError as error:
            log.error("%s: nothing can be accepted: %s", self.name, error)
        except JournalError:
            log.exception("%s: the journal cannot be trusted", self.name)
            self._stop_event.set()
        except Exception as error:
            log.exception("%s: a fault of the program", self.name)
            self._report("lost", f"a fault of the program: {error}")

    def _connected(self) -> None:
        self._report("opening", f"opening {self._settings.port}")
        with connect(self._settings, self._open) as session:
            found = session.instrument
            self._identity = identity_of(self._settings, found)
            self._patience.reset()
            self._refusals = 0
            clock = CalibrationClock(
                self._journal.bench, self._settings, found, self._now
            )
            while not (self.finished or self._loan.wanted()):
                self._one(session, clock)

    def _open(self, port: str) -> Session:
        self._report("identifying", f"asking {port} what it is")
        return Session(
            self._settings,
            port=port,
            cancelled=self._cancelled,
            heard=self._heard,
            now=self._now,
            captures=self._captures,
            opener=self._opener,
        )

    def _one(self, session: Session, clock: CalibrationClock) -> None:
        due = clock.due()
        if due is not None and due.blocks:
            self._wait_for_calibration(session, due.text)
            return
        sample = self._name_sample(self._settings.name)
        order = self._journal.orders.next_for(self._settings.name)
        wanted = f" For the order {order.order.sample!r}." if order else ""
        warning = wanted + (f" ({due.text})" if due else "")
        try:
            reading = session.read(
                sample,
                _Voice(self, "ready", session, warning),
                calibrated_at=clock.at,
            )
        except NeedsCalibrationError as error:
            self._calibrate(session, clock, str(error))
        except LinkTimeoutError as error:
            log.debug("%s: %s", self._settings.name, error)
            # Nobody pressed, or nothing is there any more: ask.
            session.identify()
        except (ProtocolError, ReadingError) as error:
            self._refuse(error)
        except WrongInstrumentError:
            raise
        except InstrumentError as error:
            self._report("ready", f"no reading: {error}")
            session.watch(WATCH_S)
        else:
            self._accept(reading, clock)
        finally:
            self._awaiting = self._transferring = False

    def _accept(self, reading: Reading, clock: CalibrationClock) -> None:
        due = clock.due()
        if due is not None and due.blocks:
            self._report("needs calibration", f"reading refused, {due.text}")
            return
        at = reading.calibration.at
        if due is None and reading.calibration.state == "unknown":
            reading = replace(reading, calibration=Calibration("valid", at))
        order = self._journal.orders.next_for(self._settings.name)
        if order is not None:
            reading = replace(reading, sample=order.order.sample)
        token = self._journal.accept_reading(reading, source=self._settings.name)
        log.info("%s %s stored", token, reading.sample)
        self._refusals = 0
        self._left = None if self._left is None else self._left - 1
        self._wake_line()

    def _refuse(self, error: ProtocolError | ReadingError) -> None:
        self._refusals += 1
        if self._refusals >= MOST_REFUSALS and isinstance(error, ProtocolError):
            raise error
        self._report("ready", f"reading refused, take it again: {error}")

    def _calibrate(self, session: Session, clock: CalibrationClock, why: str) -> None:
        self._report("needs calibration", why)
        try:
            session.calibrate(_Voice(self, "needs calibration", session))
        except LinkTimeoutError as error:
            log.info("%s: calibration: %s", self._settings.name, error)
            session.identify()
        except _NobodyReadyError:
            command = f"run `paintlink calibrate '{self._settings.name}'`"
            self._wait_for_calibration(session, f"{why}; {command}")
        else:
            clock.calibrated("by the service")

    def _wait_for_calibration(self, session: Session, why: str) -> None:
        self._report("needs calibration", why)
        session.watch(WATCH_S)

    def _cancelled(self) -> bool:
        return self._stop_event.is_set() or (
            not self._transferring and self._loan.wanted()
        )

    def _heard(self) -> None:
        if self._awaiting:
            self._awaiting = False
            self._transferring = True
            self._report("reading", "a reading is coming in")

    def tell(self, state: InstrumentState, sentence: str) -> None:
        """Show the operator a sentence; the next bytes are the reading."""
        self._report(state, sentence)
        self._transferring = False
        self._awaiting = state == "ready"

    def await_ready(
        self, state: InstrumentState, sentence: str, session: Session
    ) -> None:
        """Return once the operator is ready; a link that breaks ends the wait."""
        if state != "ready" and not self._is_ready(sentence):
            raise _NobodyReadyError(sentence)
        while state == "ready" and not self._is_ready(sentence):
            command = f"paintlink measure '{self._settings.name}'"
            self._report(state, f"{sentence} Then run `{command}`.")
            session.watch(WATCH_S)
        self._transferring = True

    def _report(self, state: InstrumentState, text: str) -> None:
        if (state, text) == self._told:
            return
        self._told = (state, text)
        log.info("%s: %s: %s", self._settings.name, state, text)
        status = InstrumentStatus(self._settings.name, state, text, self._identity)
        self._journal.set_instrument(status)


class _NobodyReadyError(Exception):
    """Nobody is there to say that a step may begin."""


class _Voice:
    """What the driver tells the operator, with the state it is told in."""

    def __init__(
        self,
        worker: InstrumentWorker,
        state: InstrumentState,
        session: Session,
        suffix: str = "",
    ) -> None:
        self._worker = worker
        self._state = state
        self._session = session
        self._suffix = suffix

    def __call__(self, sentence: str) -> None:
        self._worker.tell(self._state, sentence + self._suffix)

    def confirm(self, sentence: str) -> None:
        self._worker.await_ready(self._state, sentence + self._suffix, self._session)
