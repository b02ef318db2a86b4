from __future__ import annotations

import os
import threading
import time
import tty
from collections.abc import Iterator
from pathlib import Path

import pytest

from paintlink.daemon.loans import borrowed
from tests.daemon.instrument_bench import Desk


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    desk = Desk(tmp_path)
    yield desk
    desk.close()


def always(_sentence: str) -> bool:
    return True


def test_reading_goes_from_the_press_to_the_journal(desk: Desk) -> None:
    port = desk.plug("xrite_ma", press_s=0.05)

    worker = desk.work("xrite_ma", port.path, limit=2, captures=desk.folder / "cap")
    worker.join(20.0)

    first, second = desk.readings()
    assert first.instrument.model == "MA68II"
    assert first.origin == "simulated"
    assert first.measurement.raw != second.measurement.raw
    assert desk.status().identity == "X-Rite MA68II (bench)"
    assert len(list((desk.folder / "cap").iterdir())) == 1


def test_uncalibrated_instrument_is_calibrated_with_the_operator(desk: Desk) -> None:
    port = desk.plug("xrite_ma", press_s=0.05, calibrated=False)

    worker = desk.work("xrite_ma", port.path, limit=1)
    worker.join(20.0)

    (reading,) = desk.readings()
    assert reading.calibration.state == "valid"
    assert reading.calibration.at is not None
    assert desk.journal.bench.last_calibration("X-Rite MA68II (bench)") is not None


def test_expired_calibration_warns_and_lets_readings_pass(desk: Desk) -> None:
    port = desk.plug("xrite_ma")

    desk.work("xrite_ma", port.path)
    desk.until_state("ready")

    assert "no calibration is on record: run `paintlink calibrate" in desk.status().text
    port.press()
    desk.until(lambda: len(desk.readings()) == 1)


def test_expired_calibration_blocks_where_the_shop_wants_it(desk: Desk) -> None:
    port = desk.plug("xrite_ma")

    desk.work("xrite_ma", port.path, settings={"calibration_policy": "block"})
    desk.until_state("needs calibration")
    port.press()
    desk.journal.bench.calibrated("X-Rite MA68II (bench)", "by hand")
    desk.until_state("ready")
    assert desk.readings() == []
    port.press()

    desk.until(lambda: len(desk.readings()) == 1)


@pytest.mark.parametrize("name", ["by-id", ""])
def test_replugged_instrument_is_back_within_three_seconds(
    desk: Desk, name: str
) -> None:
    """Under the lasting name, and under another one that fits a pattern."""
    port = desk.plug("chn_cr30", name or "ttyUSB0")
    desk.work("chn_cr30", str(desk.folder / (name or "ttyUSB*")))
    desk.until_state("ready")

    port.unplug()
    desk.until_state("lost")
    if not name:
        port._link = desk.folder / "ttyUSB1"
    start = time.monotonic()
    port.replug()
    desk.until_state("ready")

    assert time.monotonic() - start < 3.0


def test_missing_device_is_absent_and_found_when_it_comes(desk: Desk) -> None:
    desk.work("chn_cr30", str(desk.folder / "by-id"))
    desk.until_state("absent")
    assert "does not exist: plug the instrument in" in desk.status().text

    desk.plug("chn_cr30", "by-id")

    desk.until_state("ready")


def test_host_started_reading_is_left_to_a_command(desk: Desk) -> None:
    port = desk.plug("chn_cr30")

    desk.work("chn_cr30", port.path)
    desk.until_state("ready")

    assert "Then run `paintlink measure 'bench'`" in desk.status().text
    assert desk.readings() == []


def test_command_borrows_the_instrument_and_gives_it_back(desk: Desk) -> None:
    port = desk.plug("chn_cr30")
    desk.work("chn_cr30", port.path)
    desk.until_state("ready")

    with borrowed(desk.folder, "bench"):
        os.close(os.open(port.path, os.O_RDWR | os.O_NOCTTY))
        desk.until(lambda: "lent to a paintlink command" in desk.status().text)

    desk.until_state("ready")


def test_operator_started_wait_is_lent_as_well(desk: Desk) -> None:
    port = desk.plug("xrite_ma")
    desk.work("xrite_ma", port.path)
    desk.until_state("ready")

    with borrowed(desk.folder, "bench"):
        desk.until(lambda: "lent to a paintlink command" in desk.status().text)


def test_another_serial_number_is_another_instrument(desk: Desk) -> None:
    port = desk.plug("chn_cr30")

    desk.work("chn_cr30", port.path, settings={"serial": "4711"})
    desk.until_state("absent")

    assert "with serial number SIM0000001, not 4711" in desk.status().text


def test_two_that_fit_are_refused_until_one_is_named(desk: Desk) -> None:
    desk.plug("chn_cr30", "ttyUSB0")
    second = desk.plug("chn_cr30", "ttyUSB1")

    desk.work("chn_cr30", str(desk.folder / "ttyUSB*"))
    desk.until_state("absent")
    assert "fit bench: write the `serial` of the one you mean" in desk.status().text
    second.unplug()

    desk.until_state("ready")


def test_instrument_is_found_among_strangers(desk: Desk) -> None:
    desk.plug("xrite_ma", "ttyUSB0")
    desk.plug("chn_cr30", "ttyUSB1")

    desk.work("chn_cr30", str(desk.folder / "ttyUSB*"))

    desk.until_state("ready")


class Dumb:
    """A terminal with nobody behind it, or somebody who never stops."""

    def __init__(self) -> None:
        self.master, self.slave = os.openpty()
        tty.setraw(self.master)
        tty.setraw(self.slave)
        self.path = os.ttyname(self.slave)
        self.going = True
        self.thread = threading.Thread(target=self._flood)

    def _flood(self) -> None:
        while self.going:
            try:
                os.write(self.master, b"U" * 512)
            except OSError:
                return

    def close(self) -> None:
        self.going = False
        os.close(self.slave)
        if self.thread.ident:
            self.thread.join(5.0)
        os.close(self.master)


@pytest.fixture
def dumb() -> Iterator[Dumb]:
    dumb = Dumb()
    yield dumb
    dumb.close()


def test_silent_instrument_is_noticed_and_stopping_is_quick(
    desk: Desk, dumb: Dumb
) -> None:
    desk.work("chn_cr30", dumb.path)

    noticed_s = desk.until_state("absent")
    assert "is silent: plug it out and in again" in desk.status().text
    start = time.monotonic()
    desk.stop.set()
    for thread in desk.threads:
        thread.join(10.0)

    assert noticed_s < 1.0 + 1.0 + 2.0
    assert time.monotonic() - start < 2.0 + 2.0


def test_flooding_instrument_is_refused_and_left_alone(desk: Desk, dumb: Dumb) -> None:
    dumb.thread.start()

    desk.work("chn_cr30", dumb.path)
    desk.until_state("absent")

    assert "check the baud rate" in desk.status().text


def test_readings_are_averaged_with_their_spread(desk: Desk) -> None:
    port = desk.plug("chn_cr30")

    worker = desk.work(
        "chn_cr30", port.path, settings={"readings": 3}, is_ready=always, limit=1
    )
    worker.join(20.0)

    (reading,) = desk.readings()
    assert reading.measurement.averaged == 3
    assert len(reading.measurement.spread) == 1
    assert 0.0 < reading.measurement.spread[0] < 1.0
