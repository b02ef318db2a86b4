from __future__ import annotations

import pytest

from paintlink_simulators import (
    ManualClock,
    MemoryPort,
    Operator,
    Panel,
    xrite_ma,
    xrite_rci,
)


@pytest.fixture
def port(simulator: xrite_ma.XriteMa, clock: ManualClock) -> MemoryPort:
    return MemoryPort(Operator(simulator, after_s=0.2), clock)


def test_armed_instrument_is_pressed(port: MemoryPort, clock: ManualClock) -> None:
    port.write(b"00A04Cw\r")
    assert port.read(1.0) == b"OK\r\n"

    report = port.read(300.0)

    assert report.startswith(b"REFLECTANCE")
    assert clock() == pytest.approx(0.2)


def test_nobody_presses_an_idle_instrument(port: MemoryPort) -> None:
    port.write(b"v\r")
    port.read(1.0)

    assert port.read(300.0) == b""


def test_each_arming_is_pressed_once(port: MemoryPort) -> None:
    for _ in range(2):
        port.write(b"00A04Cw\r")
        assert port.read(1.0) == b"OK\r\n"
        assert port.read(1.0).startswith(b"REFLECTANCE")
        assert port.read(1.0) == b""


def test_calibration_is_pressed_on_the_plaque(
    port: MemoryPort, simulator: xrite_ma.XriteMa
) -> None:
    port.write(b"3ys\ryw\r")
    port.read(0.0)

    assert port.read(120.0) == b"OK\r\n"
    assert not simulator.plate_on
    port.write(b"ys\r")
    assert port.read(1.0) == b"CALIBRATION OK\r\n"


def test_reset_sends_the_operator_away(port: MemoryPort) -> None:
    port.write(b"00A04Cw\rp\r")

    assert port.read(1.0) == b"OK\r\n"
    assert port.read(1.0) == b"RESET\r\n"
    assert port.read(1.0) == b""


def test_arming_held_up_by_a_reset_is_pressed(port: MemoryPort) -> None:
    port.write(b"p\r00A04Cw\r")

    assert port.read(1.0) == b"RESET\r\nOK\r\n"
    assert port.read(1.0).startswith(b"REFLECTANCE")


def test_press_that_is_not_noticed_is_repeated_later(
    panel: Panel, clock: ManualClock
) -> None:
    instrument = xrite_rci.create(panel, clock=clock)
    operated = Operator(instrument, 0.2)
    operated.feed(b"CS\r")
    operated.feed(b"RM\r")

    clock.advance(0.2)
    operated.poll()

    assert operated.armed
    assert operated.due_at() == pytest.approx(0.4)
