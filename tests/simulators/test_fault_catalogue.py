"""The longer catalogue: one sentence about each fault, proven on the same exchange."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from paintlink_simulators import (
    FAULTS,
    ManualClock,
    MemoryPort,
    Panel,
    chn_cr30,
    km_cm512,
    xrite_ma,
    xrite_rci,
)
from paintlink_simulators.faults import HARMLESS, STATES
from paintlink_simulators.ports import Operator

IDENTITY = b"X-RITE MA68II 3.02\r\n"
STATUS = b"CALIBRATION OK\r\n"
BASIC = {
    *("close_port", "drop_mid_frame", "duplicate_frame", "echo_on", "flip_bit"),
    *("garbage_prefix", "late", "one_byte_at_a_time", "seven_bytes_at_a_time"),
    *("silent", "truncate"),
}
"""Proven in test_faults.py."""

Ask = Callable[..., list[bytes]]


def every_byte_is_first(received: list[bytes]) -> bool:
    return received == [bytes(range(256)) + IDENTITY, bytes(range(256)) + STATUS]


def one_byte_more(received: list[bytes]) -> bool:
    whole = zip(received, (IDENTITY, STATUS), strict=True)
    return all(
        len(got) == len(sound) + 1
        and any(got[:i] + got[i + 1 :] == sound for i in range(len(got)))
        for got, sound in whole
    )


def a_control_character_more(received: list[bytes]) -> bool:
    marks = [got.translate(None, b"\x11\x13") for got in received]
    return one_byte_more(received) and marks == [IDENTITY, STATUS]


def about_half_is_lost(received: list[bytes]) -> bool:
    return all(
        0 < len(got) < len(sound)
        for got, sound in zip(received, (IDENTITY, STATUS), strict=True)
    )


PROOFS: dict[str, Callable[[list[bytes]], bool]] = {
    "bad_checksum": lambda got: (
        got == [b"X-RITE MA68II 3.03\r\n", b"CALIBRATION OL\r\n"]
    ),
    "drop_first_byte": lambda got: got == [IDENTITY[1:], STATUS[1:]],
    "every_byte_first": every_byte_is_first,
    "first_command_lost": lambda got: got == [b"", STATUS],
    "insert_byte": one_byte_more,
    "never_ends": lambda got: set(b"".join(got)) == {ord("A")} and len(got[0]) > 1000,
    "nul_flood": lambda got: got == [bytes(1000) + IDENTITY, bytes(1000) + STATUS],
    "out_of_order": lambda got: got == [b"", STATUS + IDENTITY],
    "splice": lambda got: got == [IDENTITY[10:], IDENTITY[:10] + STATUS[8:]],
    "stale_frame": lambda got: got == [IDENTITY, IDENTITY + STATUS],
    "stuck_button": lambda got: got[0].count(b"REFLECTANCE") > 50,
    "two_clients": about_half_is_lost,
    "wrong_baud": lambda got: IDENTITY not in got and STATUS not in got,
    "xon_xoff": a_control_character_more,
}


@pytest.fixture
def ask(panel: Panel, clock: ManualClock) -> Ask:
    def asked(fault: str) -> list[bytes]:
        simulator = FAULTS[fault](xrite_ma.create(panel, clock=clock, seed=7), 3)
        port = MemoryPort(simulator, clock)
        return [answer_to(port, clock, command) for command in (b"v\r", b"ys\r")]

    return asked


def answer_to(port: MemoryPort, clock: ManualClock, command: bytes) -> bytes:
    """Everything that comes within two seconds."""
    port.write(command)
    end, received = clock() + 2.0, b""
    while clock() < end:
        received += port.read(end - clock())
    return received


@pytest.mark.parametrize("fault", PROOFS)
def test_fault_does_what_its_name_says(fault: str, ask: Ask) -> None:
    received = ask(fault)

    assert PROOFS[fault](received), received


def test_every_fault_is_proven() -> None:
    assert set(FAULTS) == BASIC | set(PROOFS)
    assert set(FAULTS) > HARMLESS


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("module", [chn_cr30, km_cm512, xrite_ma, xrite_rci])
def test_every_simulator_knows_every_state(
    module: object, state: str, panel: Panel, clock: ManualClock
) -> None:
    module.create(panel, clock=clock, **STATES[state])


@pytest.mark.parametrize(
    ("state", "command", "refusal"),
    [
        ("needs_calibration", b"ys\r", b"CALIBRATION NEEDED\r\n"),
        ("lamp_warming", b"00A04Cw\r", b"LAMP WARMING UP\r\n"),
        ("low_battery", b"00A04Cw\r", b"BATTERY LOW\r\n"),
        ("memory_full", b"00A04Cw\r", b"MEMORY FULL\r\n"),
    ],
)
def test_state_of_the_ma_family_is_said(
    panel: Panel, clock: ManualClock, state: str, command: bytes, refusal: bytes
) -> None:
    instrument = xrite_ma.create(panel, clock=clock, **STATES[state])

    assert instrument.feed(command) == refusal
    if state != "needs_calibration":
        assert instrument.press() == refusal


@pytest.mark.parametrize("state", ["nan_value", "lab_out_of_range"])
def test_defect_shows_in_what_is_sent(
    panel: Panel, clock: ManualClock, state: str
) -> None:
    nan = state == "nan_value"
    ma = xrite_ma.create(panel, clock=clock, **STATES[state])
    Operator(ma, 0.0).press()
    dump = bytes.fromhex(ma.feed(b"207B2000i\r").split(b"OK")[0].decode())
    assert (np.frombuffer(dump, "<i4")[5] == 0x7FFFFFFF) == nan
    assert nan or np.frombuffer(dump, "<i4")[5] == 20 * 32768

    km = km_cm512.create(panel, clock=clock, **STATES[state])
    km.feed(b"MES\r&\r")
    clock.advance(3.0)
    assert km.poll().split(b",")[7] == (b"***.**" if nan else b"999.99")

    cr = chn_cr30.create(panel, clock=clock, **STATES[state])
    cr.press()
    frame = bytes((0xBB, 1, 0x10)).ljust(58, b"\0") + b"\xff\xcb"
    (value,) = np.frombuffer(cr.feed(frame)[26:30], "<f4")
    assert np.isnan(value) if nan else value == 2000.0

    rci = xrite_rci.create(panel, clock=clock, **STATES[state])
    rci.press()
    rci.feed(b"011BCF\r")
    assert rci.feed(b"01GM\r")[10:12] == b"\xff\xff"
