"""Real pseudo-terminals: their other end is opened by name, as a driver does it."""

from __future__ import annotations

import contextlib
import errno
import os
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from paintlink.errors import LinkError
from paintlink_simulators import FAULTS, ManualClock, Panel, PtyPort, xrite_ma

IDENTITY = b"X-RITE MA68II 3.02\r\n"
REPORT_LINES = 37

OpenTerminal = Callable[[str], Any]


@pytest.fixture
def port(simulator: xrite_ma.XriteMa) -> Iterator[PtyPort]:
    with PtyPort(simulator) as port:
        yield port


def bytes_after_unplugging(descriptor: int) -> bytes:
    """Everything left to read; a terminal that has gone ends in EOF or EIO."""
    received = b""
    with contextlib.suppress(OSError):
        while data := os.read(descriptor, 4096):
            received += data
    return received


def descriptors() -> int:
    return len([*Path("/proc/self/fd").iterdir()])


def test_command_is_answered_over_a_terminal(
    port: PtyPort, terminal: OpenTerminal
) -> None:
    client = terminal(port.path)

    client.write(b"v\r")

    assert client.read_until(b"\n") == IDENTITY


def test_terminal_changes_no_byte(port: PtyPort, terminal: OpenTerminal) -> None:
    client = terminal(port.path)

    client.write(b"\x03\x04\x11\x13\x7f\n\r")

    assert client.read_until(b"\n") == b"?\r\n"


def test_second_client_follows_the_first(port: PtyPort, terminal: OpenTerminal) -> None:
    first = terminal(port.path)
    first.write(b"ys\r")
    first.read_until(b"\n")
    first.close()

    second = terminal(port.path)
    second.write(b"v\r")

    assert second.read_until(b"\n") == IDENTITY


def test_press_sends_the_report(port: PtyPort, terminal: OpenTerminal) -> None:
    client = terminal(port.path)

    port.press()

    assert client.read_lines(REPORT_LINES)[-1].startswith(b"110 ")


def test_reset_comes_by_the_clock(panel: Panel, terminal: OpenTerminal) -> None:
    with PtyPort(xrite_ma.create(panel, clock=time.monotonic)) as port:
        client = terminal(port.path)

        client.write(b"p\r")

        assert client.read_until(b"\n") == b"RESET\r\n"


def test_operator_presses_after_arming(panel: Panel, terminal: OpenTerminal) -> None:
    simulator = xrite_ma.create(panel, clock=time.monotonic)
    with PtyPort(simulator, auto_press_after_s=0.05) as port:
        client = terminal(port.path)

        client.write(b"00A04Cw\r")

        lines = client.read_lines(1 + REPORT_LINES)
        assert lines[0] == b"OK"
        assert lines[-1].startswith(b"110 ")


def test_paced_answer_arrives_whole(panel: Panel, terminal: OpenTerminal) -> None:
    simulator = xrite_ma.create(panel, clock=time.monotonic)
    with PtyPort(simulator, baud=115200) as port:
        client = terminal(port.path)

        client.write(b"207B2000i\r")

        assert len(client.read_until(b"OK\r\n")) == 380


def test_unread_reports_wait_for_the_reader(
    port: PtyPort, terminal: OpenTerminal
) -> None:
    client = terminal(port.path)

    # More than the kernel holds for a terminal.
    for _ in range(20):
        port.press()

    assert client.read_lines(20 * REPORT_LINES)[-1].startswith(b"110 ")


def test_presses_from_many_threads_stay_whole(
    port: PtyPort, terminal: OpenTerminal, panel: Panel
) -> None:
    client = terminal(port.path)
    one_by_one = xrite_ma.create(panel, clock=ManualClock(), seed=7)
    expected = b"".join(one_by_one.press() for _ in range(12))

    def press_three_times() -> None:
        for _ in range(3):
            port.press()

    threads = [threading.Thread(target=press_three_times) for _ in range(4)]
    for thread in threads:
        thread.start()
    received = b""
    while len(received) < len(expected):
        received += client.read()
    for thread in threads:
        thread.join()

    assert received == expected


def test_unplugged_terminal_is_really_gone(
    port: PtyPort, terminal: OpenTerminal
) -> None:
    client = terminal(port.path)

    port.unplug()

    assert bytes_after_unplugging(client.descriptor) == b""
    with pytest.raises(OSError, match="Input/output error") as fault:
        client.write(b"v\r")
    assert fault.value.errno == errno.EIO
    assert not Path(port.path).exists()


def test_unplugging_wakes_a_waiting_reader(
    port: PtyPort, terminal: OpenTerminal
) -> None:
    client = terminal(port.path)
    ended: list[bytes] = []
    reader = threading.Thread(
        target=lambda: ended.append(bytes_after_unplugging(client.descriptor))
    )
    reader.start()

    port.unplug()

    reader.join(5.0)
    assert ended == [b""]


def test_replugging_gives_a_new_path_and_moves_the_link(
    simulator: xrite_ma.XriteMa, terminal: OpenTerminal, tmp_path: Path
) -> None:
    link = tmp_path / "by-id"
    with PtyPort(simulator, link=link) as port:
        before = port.path
        assert link.readlink() == Path(before)

        port.unplug()
        assert not link.is_symlink()
        after = port.replug()

        assert after == port.path != before
        assert link.readlink() == Path(after)
        client = terminal(str(link))
        client.write(b"v\r")
        assert client.read_until(b"\n") == IDENTITY
    assert not link.is_symlink()


def test_replugging_answers_nothing_from_before(
    port: PtyPort, clock: ManualClock, terminal: OpenTerminal
) -> None:
    before = terminal(port.path)
    before.write(b"v\rp\r")
    before.read_until(b"\n")

    port.unplug()
    after = terminal(port.replug())
    clock.advance(1.0)
    after.write(b"v\r")

    assert after.read_until(b"\n") == IDENTITY


def test_replugging_forgets_half_a_command(
    port: PtyPort, terminal: OpenTerminal
) -> None:
    before = terminal(port.path)
    before.write(b"v\rys")
    before.read_until(b"\n")

    port.unplug()
    after = terminal(port.replug())
    after.write(b"v\r")

    assert after.read_until(b"\n") == IDENTITY


def test_replugging_sends_nothing_left_over(
    panel: Panel, terminal: OpenTerminal
) -> None:
    simulator = xrite_ma.create(panel, clock=ManualClock())
    with PtyPort(simulator, baud=1200) as port:
        before = terminal(port.path)
        before.write(b"207B2000i\r")
        before.read()

        port.unplug()
        after = terminal(port.replug())
        after.write(b"v\r")

        assert after.read_until(b"\n") == IDENTITY


def test_press_while_unplugged_is_lost(port: PtyPort, terminal: OpenTerminal) -> None:
    port.unplug()
    port.press()

    assert port._outgoing == b""
    client = terminal(port.replug())
    client.write(b"v\r")

    assert client.read_until(b"\n") == IDENTITY


def test_cutting_fault_unplugs_after_its_bytes(
    simulator: xrite_ma.XriteMa, terminal: OpenTerminal
) -> None:
    with PtyPort(FAULTS["close_port"](simulator, 0)) as port:
        client = terminal(port.path)
        client.write(b"207B2000i\r")

        # What a terminal holds unread is lost when it goes: at most 100 bytes come.
        received = bytes_after_unplugging(client.descriptor)

        assert len(received) <= 100
        again = terminal(port.replug())
        again.write(b"v\r")
        assert again.read_until(b"\n") == IDENTITY


def test_closing_twice_leaves_nothing_running(simulator: xrite_ma.XriteMa) -> None:
    port = PtyPort(simulator)
    threads = threading.active_count()

    port.close()
    port.close()

    assert threading.active_count() == threads - 1
    with pytest.raises(LinkError, match="port is closed: open a new one"):
        port.press()


def test_descriptors_are_given_back(simulator: xrite_ma.XriteMa) -> None:
    before = descriptors()

    with PtyPort(simulator) as port:
        port.unplug()
        port.replug()
        port.replug()

    assert descriptors() == before


def test_link_that_cannot_be_made_leaves_nothing(
    simulator: xrite_ma.XriteMa, tmp_path: Path
) -> None:
    before = threading.active_count(), descriptors()

    with pytest.raises(FileNotFoundError, match="absent"):
        PtyPort(simulator, link=tmp_path / "absent" / "by-id")

    assert (threading.active_count(), descriptors()) == before
