from __future__ import annotations

import pytest

from paintlink.errors import LinkError
from paintlink_simulators import FAULTS, ManualClock, MemoryPort, xrite_ma

IDENTITY = b"X-RITE MA68II 3.02\r\n"


def test_answer_is_read_after_a_write(simulator: xrite_ma.XriteMa) -> None:
    port = MemoryPort(simulator)

    port.write(b"v\r")

    assert port.read(0.0) == IDENTITY
    assert port.read(0.0) == b""


def test_press_is_read_like_an_answer(simulator: xrite_ma.XriteMa) -> None:
    port = MemoryPort(simulator)

    port.press()

    assert port.read(0.0).startswith(b"REFLECTANCE")


def test_reads_return_at_most_a_chunk(simulator: xrite_ma.XriteMa) -> None:
    port = MemoryPort(simulator, chunk_bytes=8)

    port.write(b"v\r")

    assert [port.read(0.0) for _ in range(4)] == [
        IDENTITY[:8],
        IDENTITY[8:16],
        IDENTITY[16:],
        b"",
    ]


def test_without_clock_a_read_advances_nothing(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    port = MemoryPort(simulator)
    port.write(b"p\r")

    assert port.read(10.0) == b""
    assert clock() == 0.0
    clock.advance(0.3)
    assert port.read(10.0) == b"RESET\r\n"


def test_waiting_takes_only_as_long_as_needed(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    port = MemoryPort(simulator, clock)
    port.write(b"p\r")

    assert port.read(0.2) == b""
    assert clock() == pytest.approx(0.2)
    assert port.read(2.0) == b"RESET\r\n"
    assert clock() == pytest.approx(0.3)


def test_silence_takes_the_whole_timeout(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    port = MemoryPort(simulator, clock)

    assert port.read(2.0) == b""
    assert clock() == pytest.approx(2.0)


@pytest.mark.parametrize("timeout_s", [0.0, 1e-12])
def test_every_read_lets_time_pass(
    simulator: xrite_ma.XriteMa, timeout_s: float
) -> None:
    clock = ManualClock(1e6)

    MemoryPort(simulator, clock).read(timeout_s)

    assert 1e6 < clock() < 1e6 + 1e-3


def test_closed_port_refuses_everything(simulator: xrite_ma.XriteMa) -> None:
    port = MemoryPort(simulator)
    port.write(b"v\r")
    port.close()

    with pytest.raises(LinkError, match="closed: open a new port"):
        port.read(0.0)
    with pytest.raises(LinkError, match="closed: open a new port"):
        port.write(b"v\r")
    with pytest.raises(LinkError, match="closed: open a new port"):
        port.press()


def test_new_port_answers_nothing_old(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    old = MemoryPort(simulator, clock)
    old.write(b"p\rys")
    old.close()

    port = MemoryPort(simulator, clock)
    port.write(b"v\r")

    assert port.read(1.0) == IDENTITY
    assert port.read(1.0) == b""


def test_cut_line_delivers_and_then_fails(
    simulator: xrite_ma.XriteMa, clock: ManualClock
) -> None:
    port = MemoryPort(FAULTS["close_port"](simulator, 0), clock)
    port.write(b"207B2000i\r")

    received = port.read(1.0)

    assert len(received) == 100
    with pytest.raises(LinkError, match="closed"):
        port.read(1.0)


def test_manual_clock_never_runs_backwards() -> None:
    clock = ManualClock(5.0)

    clock.advance_to(4.0)
    clock.advance(0.5)

    assert clock() == pytest.approx(5.5)
