from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import closing

import pytest

from paintlink_simulators import ManualClock, TcpPort, xrite_ma

IDENTITY = b"X-RITE MA68II 3.02\r\n"


@pytest.fixture
def port(simulator: xrite_ma.XriteMa) -> Iterator[TcpPort]:
    with TcpPort(simulator) as port:
        yield port


def client_of(port: TcpPort) -> closing[socket.socket]:
    host, _, number = port.url.removeprefix("socket://").partition(":")
    return closing(socket.create_connection((host, int(number)), timeout=10.0))


def read_line(client: socket.socket) -> bytes:
    received = b""
    while not received.endswith(b"\n"):
        data = client.recv(4096)
        assert data, "the simulator hung up"
        received += data
    return received


def test_url_is_what_pyserial_opens(port: TcpPort) -> None:
    assert port.url.startswith("socket://127.0.0.1:")


def test_command_is_answered_over_tcp(port: TcpPort) -> None:
    with client_of(port) as client:
        client.sendall(b"v\r")

        assert read_line(client) == IDENTITY


def test_press_reaches_the_client(port: TcpPort) -> None:
    with client_of(port) as client:
        client.sendall(b"v\r")
        read_line(client)

        port.press()

        assert read_line(client).startswith(b"REFLECTANCE")


def test_second_client_is_turned_away(port: TcpPort) -> None:
    with client_of(port) as first, client_of(port) as second:
        first.sendall(b"v\r")
        read_line(first)

        assert second.recv(100) == b""
        first.sendall(b"ys\r")
        assert read_line(first) == b"CALIBRATION OK\r\n"


def test_next_client_gets_nothing_from_before(
    port: TcpPort, clock: ManualClock
) -> None:
    with client_of(port) as first:
        first.sendall(b"v\rp\rys")
        read_line(first)

    with client_of(port) as second:
        clock.advance(1.0)
        second.sendall(b"v\r")

        assert read_line(second) == IDENTITY


def test_client_that_resets_is_replaced(port: TcpPort) -> None:
    with client_of(port) as first:
        first.sendall(b"v\r")
        read_line(first)
        first.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")

    with client_of(port) as second:
        second.sendall(b"v\r")

        assert read_line(second) == IDENTITY


def test_closing_hangs_up_and_stops_listening(simulator: xrite_ma.XriteMa) -> None:
    port = TcpPort(simulator)
    with client_of(port) as client:
        client.sendall(b"v\r")
        read_line(client)

        port.close()

        assert client.recv(100) == b""
    with pytest.raises(ConnectionRefusedError, match="refused"):
        client_of(port)
