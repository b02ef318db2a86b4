from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator

import pytest

from paintlink.errors import LinkError
from paintlink_simulators import xrite_ma
from paintlink_simulators.ports.server import Server

IDENTITY = b"X-RITE MA68II 3.02\r\n"


class ScriptedLine:
    """A socket pair whose calls fail as the given errors say, one after another."""

    def __init__(self, errors: dict[str, list[OSError]]) -> None:
        self.client, self._socket = socket.socketpair()
        self.client.settimeout(10.0)
        self._socket.setblocking(False)
        self._errors = errors

    def fileno(self) -> int:
        return self._socket.fileno()

    def receive(self) -> bytes:
        self._fail("receive")
        return self._socket.recv(4096)

    def send(self, data: bytes) -> int:
        self._fail("send")
        return self._socket.send(data)

    def close(self) -> None:
        self._socket.close()

    def _fail(self, call: str) -> None:
        if self._errors.get(call):
            raise self._errors[call].pop()


def ends(client: socket.socket) -> bool:
    """Whether the other end has gone; unread bytes make that a reset."""
    try:
        return client.recv(100) == b""
    except ConnectionResetError:
        return True


@pytest.fixture
def plugged(
    simulator: xrite_ma.XriteMa,
) -> Iterator[Callable[..., tuple[Server, socket.socket]]]:
    lines: list[ScriptedLine] = []
    with Server(simulator) as server:

        def plug(**errors: list[OSError]) -> tuple[Server, socket.socket]:
            lines.append(ScriptedLine(errors))
            server._plug(lines[-1])
            return server, lines[-1].client

        yield plug
    for line in lines:
        line.client.close()


@pytest.mark.parametrize("call", ["receive", "send"])
def test_call_that_would_block_is_repeated(
    plugged: Callable[..., tuple[Server, socket.socket]], call: str
) -> None:
    _, client = plugged(**{call: [BlockingIOError(), BlockingIOError()]})

    client.sendall(b"v\r")

    assert client.recv(100) == IDENTITY


@pytest.mark.parametrize("call", ["receive", "send"])
def test_line_that_fails_is_hung_up(
    plugged: Callable[..., tuple[Server, socket.socket]], call: str
) -> None:
    _, client = plugged(**{call: [BrokenPipeError()]})

    client.sendall(b"v\r")

    assert ends(client)


def test_new_line_replaces_the_old_one(
    plugged: Callable[..., tuple[Server, socket.socket]],
) -> None:
    _, old = plugged()

    _, new = plugged()
    new.sendall(b"v\r")

    assert new.recv(100) == IDENTITY
    assert old.recv(100) == b""


def test_failing_press_is_raised_and_survived(
    plugged: Callable[..., tuple[Server, socket.socket]], simulator: xrite_ma.XriteMa
) -> None:
    server, client = plugged()
    simulator.panel = None  # type: ignore[assignment]

    with pytest.raises(AttributeError, match="factors_at"):
        server.press()

    client.sendall(b"v\r")
    assert client.recv(100) == IDENTITY


def test_calls_during_closing_are_refused(
    plugged: Callable[..., tuple[Server, socket.socket]],
) -> None:
    server, _ = plugged()
    refusals: list[str] = []

    def press_until_refused() -> None:
        try:
            while True:
                server.press()
        except LinkError as refusal:
            refusals.append(str(refusal))

    threads = [threading.Thread(target=press_until_refused) for _ in range(3)]
    for thread in threads:
        thread.start()

    server.close()

    for thread in threads:
        thread.join(10.0)
    assert refusals == ["the simulator's port is closed: open a new one"] * 3
