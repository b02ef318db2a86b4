from __future__ import annotations

from datetime import timedelta
from pathlib import Path

import pytest

from paintlink.config import InstrumentSettings
from paintlink.daemon.calibration import CalibrationClock, identity_of
from paintlink.daemon.journal import Journal
from paintlink.model import Instrument, Lab
from tests.daemon.conftest import NOON

CR30 = Instrument("CHNSpec", "CR30", "7")


class Desk:
    """A journal and a clock on one desk."""

    def __init__(self, folder: Path) -> None:
        self.now = NOON
        self.path = folder / "journal.db"
        self.journal = Journal(self.path, now=lambda: self.now)

    def clock(self, policy: str = "warn", hours: float = 8.0) -> CalibrationClock:
        settings = InstrumentSettings(
            name="bench",
            driver="chn_cr30",
            port="/dev/ttyUSB0",
            calibration_policy=policy,  # type: ignore[arg-type]
            calibration_h=hours,
        )
        return CalibrationClock(self.journal.bench, settings, CR30, lambda: self.now)

    def reopen(self) -> None:
        self.journal.close()
        self.journal = Journal(self.path, now=lambda: self.now)


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def test_calibration_lasts_its_hours_and_not_longer(desk: Desk) -> None:
    clock = desk.clock()
    clock.calibrated("by hand")

    desk.now += timedelta(hours=8)
    assert clock.due() is None
    desk.now += timedelta(minutes=3)
    due = clock.due()

    assert due is not None
    assert due.text == (
        "calibrated 8.1 h ago, allowed are 8 h: run `paintlink calibrate 'bench'`"
    )
    assert not due.blocks


def test_calibration_outlives_the_program(desk: Desk) -> None:
    desk.clock().calibrated("by hand")
    desk.reopen()
    desk.now += timedelta(hours=3)

    assert desk.clock().at == NOON
    assert desk.clock().due() is None


def test_unknown_calibration_is_due(desk: Desk) -> None:
    due = desk.clock("block").due()

    assert due is not None
    assert due.text.startswith("no calibration is on record: run `paintlink calibrate")
    assert due.blocks


def test_clock_that_went_back_makes_it_due(desk: Desk) -> None:
    desk.clock().calibrated("by hand")
    desk.now -= timedelta(days=10)

    due = desk.clock().due()

    assert due is not None
    assert "2026-11-22 12:00, is to come" in due.text


def test_serial_number_is_what_an_instrument_is_remembered_by() -> None:
    settings = InstrumentSettings(name="a", driver="d", port="p")

    assert identity_of(settings, CR30) == "CHNSpec CR30 7"
    assert identity_of(settings, Instrument("X", "MA68")) == "X MA68 (a)"


def test_drift_is_counted_from_the_first_reading_of_the_tile(desk: Desk) -> None:
    bench, angles = desk.journal.bench, (15.0, 45.0)
    green = [Lab(50.0, -30.0, 10.0), Lab(40.0, -28.0, 9.0)]

    first = bench.check_tile("CR30", "green", angles, green)
    bench.check_tile("CR30", "white", angles, [Lab(95.0, 0.0, 0.0)] * 2)
    steady = bench.check_tile(
        "CR30", "green", angles, [green[0]._replace(L=50.3), green[1]]
    )
    warning = bench.check_tile(
        "CR30", "green", angles, [green[0], green[1]._replace(L=40.7)]
    )
    alarm = bench.check_tile("CR30", "green", (45.0,), [green[1]._replace(L=42.0)])

    assert (first.verdict, first.drift) == ("first", {})
    assert steady.drift == pytest.approx({15.0: 0.3, 45.0: 0.0})
    assert [one.verdict for one in (steady, warning, alarm)] == [
        *("steady", "warning", "alarm"),
    ]
    assert alarm.drift == pytest.approx({45.0: 2.0})
    assert len(bench.tile_checks("CR30")) == 5
    assert len(bench.tile_checks("CR30", "green")) == 4
    assert bench.tile_checks("another") == ()
