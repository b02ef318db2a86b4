"""One reading by hand, at an instrument that a running service lends."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from paintlink.config import InstrumentSettings, Settings
from paintlink.daemon.averaging import lab_of
from paintlink.daemon.bench import TileCheck
from paintlink.daemon.calibration import CalibrationClock, identity_of
from paintlink.daemon.database import utc_now
from paintlink.daemon.journal import Journal
from paintlink.daemon.loans import borrowed
from paintlink.daemon.session import Session
from paintlink.errors import NeedsCalibrationError
from paintlink.instrument import Confirming
from paintlink.model import Calibration, Lab, Reading


@contextmanager
def at_hand(
    settings: Settings, instrument: InstrumentSettings, *, captures: Path | None = None
) -> Iterator[Session]:
    """An identified session with an instrument that nobody else uses meanwhile."""
    with (
        borrowed(settings.state_folder, instrument.name),
        Session(instrument, captures=captures) as session,
    ):
        yield session


def take(
    session: Session, clock: CalibrationClock, sample: str, operator: Confirming
) -> Reading:
    """One reading, with the time of the calibration it rests on.

    Raises
    ------
    NeedsCalibrationError
        When the calibration is too old and the policy is to block.
    """
    due = clock.due()
    if due is not None and due.blocks:
        raise NeedsCalibrationError(due.text)
    if due is not None:
        operator(f"Warning: {due.text}.")
    reading = session.read(sample, operator, calibrated_at=clock.at)
    if due is None and reading.calibration.state == "unknown":
        return replace(reading, calibration=Calibration("valid", clock.at))
    return reading


def clock_of(
    journal: Journal, instrument: InstrumentSettings, session: Session
) -> CalibrationClock:
    """The calibration clock of the instrument in a session."""
    return CalibrationClock(journal.bench, instrument, session.instrument, utc_now)


def take_stored(journal: Journal, session: Session, source: str) -> tuple[int, int]:
    """Numbers of readings that were new, and that were imported before."""
    new = known = 0
    for reading in session.stored():
        if journal.knows(reading):
            known += 1
            continue
        journal.accept_reading(reading, source=source)
        new += 1
    return new, known


def check_tile(
    journal: Journal,
    instrument: InstrumentSettings,
    session: Session,
    *,
    tile: str,
    operator: Confirming,
) -> TileCheck:
    """One reading of a check tile, kept and compared with the first one."""
    measured = session.read(tile, operator).measurement
    angles = tuple(one.aspecular_deg for one in measured.geometries)
    lab = [Lab(*row) for row in lab_of(measured).tolist()]
    identity = identity_of(instrument, session.instrument)
    return journal.bench.check_tile(identity, tile, angles, lab)
