"""USB devices around a simulator, asked as a kernel asks them."""

from __future__ import annotations

import struct
import threading
from typing import Any

import pytest

from paintlink_simulators import LineSettings, ManualClock, Panel, xrite_ma
from paintlink_simulators.usb import (
    AcmFunction,
    Ch341Function,
    Engine,
    FtdiFunction,
    Setup,
    StallError,
    Urb,
)
from paintlink_simulators.usb._requests import split

IDENTITY = b"X-RITE MA68II 3.02\r\n"
TO_DEVICE, FROM_DEVICE = 0x40, 0xC0
ACM_OUT, ACM_IN = 0x21, 0xA1
EVERY_ADAPTER = [AcmFunction, FtdiFunction, Ch341Function]


@pytest.fixture
def instrument(panel: Panel, clock: ManualClock) -> xrite_ma.XriteMa:
    return xrite_ma.create(panel, clock=clock)


def received(function: Any, clock: ManualClock) -> bytes:
    """The characters of the next packets, the status of an FTDI taken out."""
    data = b""
    for _ in range(10):
        function.poll()
        packet = function.in_packet(function.DATA_IN) or b""
        data += packet[2:] if isinstance(function, FtdiFunction) else packet
        clock.advance(0.02)
    return data


@pytest.mark.parametrize("kind", EVERY_ADAPTER)
def test_configuration_is_as_long_as_it_says(kind: Any) -> None:
    parts = split(kind.CONFIGURATION)

    assert struct.unpack_from("<H", kind.CONFIGURATION, 2)[0] == len(kind.CONFIGURATION)
    assert len(kind.DEVICE) == 18
    assert [one[1] for one in parts].count(4) == kind.CONFIGURATION[4]


@pytest.mark.parametrize("kind", EVERY_ADAPTER)
def test_adapter_passes_questions_and_answers(
    kind: Any, instrument: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    function = kind(instrument)
    function.out_packet(b"v\r")

    assert received(function, clock) == IDENTITY


def test_acm_takes_and_tells_its_line_coding(instrument: xrite_ma.XriteMa) -> None:
    function = AcmFunction(instrument)
    coding = struct.pack("<IBBB", 4800, 2, 2, 7)

    function.control(Setup(ACM_OUT, 0x20, 0, 0, 7), coding)
    function.control(Setup(ACM_OUT, 0x22, 3, 0, 0), b"")
    function.control(Setup(ACM_OUT, 0x23, 0xFFFF, 0, 0), b"")

    assert function.host_line == LineSettings(4800.0, 7, "E", 2.0)
    assert function.control(Setup(ACM_IN, 0x21, 0, 0, 7), b"") == coding
    assert (function.dtr, function.rts, function.breaks) == (True, True, 1)


@pytest.mark.parametrize(
    ("value", "index", "baud"),
    [(0x4138, 0, 9600.0), (0x001A, 0, 115384.6), (0xC027, 0, 76677.3)],
)
def test_ftdi_divisor_is_a_baud_rate(
    instrument: xrite_ma.XriteMa, value: int, index: int, baud: float
) -> None:
    function = FtdiFunction(instrument)

    function.control(Setup(TO_DEVICE, 3, value, index, 0), b"")

    assert function.host_line.baudrate == pytest.approx(baud, rel=1e-3)


def test_ftdi_takes_form_modem_lines_and_break(instrument: xrite_ma.XriteMa) -> None:
    function = FtdiFunction(instrument)

    function.control(Setup(TO_DEVICE, 4, 0x4207 | 2 << 11, 0, 0), b"")
    function.control(Setup(TO_DEVICE, 1, 0x0303, 0, 0), b"")

    line = function.host_line
    assert (line.bytesize, line.parity, line.stopbits) == (7, "E", 2.0)
    assert (function.dtr, function.rts, function.breaks) == (True, True, 1)


def test_ftdi_sends_its_status_when_it_has_nothing_else(
    instrument: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    function = FtdiFunction(instrument)

    assert function.in_packet(0x81) is None
    clock.advance(0.016)
    assert function.in_packet(0x81) == bytes((0x31, 0x60))
    assert function.in_packet(0x81) is None


def test_ftdi_waits_for_a_host_that_reads(
    instrument: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    function = FtdiFunction(instrument)
    assert function.due_at() == pytest.approx(clock() + 0.016)

    clock.advance(60.0)

    assert function.due_at() is None
    assert function.in_packet(function.DATA_IN) == FtdiFunction.STATUS
    assert function.due_at() == pytest.approx(clock() + 0.016)


def test_ch341_registers_set_the_line(instrument: xrite_ma.XriteMa) -> None:
    function = Ch341Function(instrument)

    # Prescaler 2, divisor 156 and 217 of 48 MHz / 64 / 2.
    function.control(Setup(TO_DEVICE, 0x9A, 0x1312, 0xB282, 0), b"")
    function.control(Setup(TO_DEVICE, 0x9A, 0x2518, 0xDA, 0), b"")

    assert function.host_line.baudrate == pytest.approx(9615.0, rel=0.01)
    assert (function.host_line.bytesize, function.host_line.parity) == (7, "E")
    assert function.control(Setup(FROM_DEVICE, 0x5F, 0, 0, 2), b"") == b"\x31\x00"


@pytest.mark.parametrize("kind", EVERY_ADAPTER)
def test_unknown_request_is_refused(kind: Any, instrument: xrite_ma.XriteMa) -> None:
    with pytest.raises(StallError):
        kind(instrument).control(Setup(FROM_DEVICE, 0x77, 0, 0, 8), b"")


def test_line_set_otherwise_hears_garbage(
    instrument: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    function = AcmFunction(instrument, line=LineSettings(4800.0))
    function.out_packet(b"v\r")
    assert received(function, clock) != IDENTITY
    instrument.disconnect()

    function.control(Setup(ACM_OUT, 0x20, 0, 0, 7), struct.pack("<IBBB", 4800, 0, 0, 8))
    function.out_packet(b"v\r")

    assert received(function, clock) == IDENTITY


def test_paced_answer_takes_the_time_of_its_line(
    instrument: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    function = AcmFunction(instrument, line=LineSettings(9600.0), paced=True)
    function.out_packet(b"v\r")

    clock.advance(10.5 * 10 / 9600)
    function.poll()

    assert function.in_packet(0x81) == IDENTITY[:10]


def test_full_packet_is_followed_by_an_empty_one(
    panel: Panel, clock: ManualClock
) -> None:
    instrument = xrite_ma.create(panel, clock=clock, identity="X" * 62)
    sound, faulty = AcmFunction(instrument), AcmFunction(instrument, zlp=False)
    for function in (sound, faulty):
        function.out_packet(b"v\r")
        assert len(function.in_packet(0x81) or b"") == 64

    assert sound.in_packet(0x81) == b""
    assert faulty.in_packet(0x81) is None


def test_unplugging_ends_every_request(instrument: xrite_ma.XriteMa) -> None:
    engine = Engine(AcmFunction(instrument))
    ended = threading.Event()
    waiting = Urb(0x81, lambda _: ended.set(), length=64)
    engine.submit(waiting)
    assert waiting.status is None

    engine.unplug()
    late = Urb(0x81, lambda _: None, length=64)
    engine.submit(late)

    assert ended.is_set()
    assert waiting.status == late.status == -108


def test_request_taken_back_is_never_finished(instrument: xrite_ma.XriteMa) -> None:
    engine = Engine(AcmFunction(instrument))
    finished: list[Urb] = []
    urb = Urb(0x81, finished.append, length=64)
    engine.submit(urb)

    assert engine.unlink(urb)
    assert not engine.unlink(urb)
    engine.unplug()
    assert not finished
