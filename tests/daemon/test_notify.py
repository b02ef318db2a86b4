from __future__ import annotations

import logging
import os
import socket
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

import pytest

from paintlink.daemon.notify import Notifier


@pytest.fixture(params=["path", "abstract"])
def name(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """What systemd writes into NOTIFY_SOCKET, for both kinds of address."""
    if request.param == "abstract":
        return f"@paintlink-test-{uuid4()}"
    return str(tmp_path / "notify")


@pytest.fixture
def systemd(name: str) -> Iterator[socket.socket]:
    """The receiving end."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as receiver:
        receiver.settimeout(5.0)
        receiver.bind(name.replace("@", "\0", 1))
        yield receiver


def test_each_event_is_one_datagram(systemd: socket.socket, name: str) -> None:
    notifier = Notifier({"NOTIFY_SOCKET": name})

    notifier.ready("2 instruments")
    notifier.status("bench: ready")
    notifier.watchdog()
    notifier.stopping()

    assert [systemd.recv(1000) for _ in range(4)] == [
        b"READY=1\nSTATUS=2 instruments",
        b"STATUS=bench: ready",
        b"WATCHDOG=1",
        b"STOPPING=1",
    ]


def test_status_cannot_add_an_assignment(systemd: socket.socket, name: str) -> None:
    Notifier({"NOTIFY_SOCKET": name}).status("Café\nMAINPID=1\r\n\udce9")

    assert systemd.recv(1000) == "STATUS=Café MAINPID=1 ?".encode()


@pytest.mark.parametrize("address", [None, "", "vsock:2:1234", "relative/name"])
def test_nobody_listening_is_fine(
    address: str | None, caplog: pytest.LogCaptureFixture
) -> None:
    notifier = Notifier({} if address is None else {"NOTIFY_SOCKET": address})

    notifier.ready("started")
    notifier.stopping()

    assert caplog.messages == []


def test_vanished_socket_is_logged_not_raised(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    gone = str(tmp_path / "gone")

    with caplog.at_level(logging.WARNING):
        Notifier({"NOTIFY_SOCKET": gone}).ready("started")

    (message,) = caplog.messages
    assert message.startswith("systemd could not be told READY=1: [Errno 2]")


def test_watchdog_is_fed_twice_as_often_as_asked() -> None:
    notifier = Notifier({"WATCHDOG_USEC": "30000000"})

    assert notifier.watchdog_interval_s == 15.0


@pytest.mark.parametrize(
    "environ",
    [
        {},
        {"WATCHDOG_USEC": "0"},
        {"WATCHDOG_USEC": "soon"},
        {"WATCHDOG_USEC": "-5"},
        {"WATCHDOG_USEC": "30000000", "WATCHDOG_PID": "1"},
    ],
    ids=["unset", "zero", "no number", "negative", "other process"],
)
def test_watchdog_may_be_off(environ: dict[str, str]) -> None:
    assert Notifier(environ).watchdog_interval_s is None


def test_watchdog_meant_for_us_counts() -> None:
    environ = {"WATCHDOG_USEC": "2000000", "WATCHDOG_PID": str(os.getpid())}

    assert Notifier(environ).watchdog_interval_s == 1.0
