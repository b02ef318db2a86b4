"""A simulator behind a TCP port on this machine, as a serial device server has it."""

from __future__ import annotations

import socket

from paintlink_simulators._simulator import Simulator
from paintlink_simulators.ports.server import Server


class TcpPort(Server):
    """A simulator at ``url``, for one client at a time; others are turned away.

    Parameters
    ----------
    port
        0 lets the system choose.
    """

    def __init__(
        self,
        simulator: Simulator,
        *,
        host: str = "127.0.0.1",
        port: int = 0,
        baud: int | None = None,
        auto_press_after_s: float | None = None,
    ) -> None:
        listener = _Listener(host, port)
        super().__init__(
            simulator,
            listener=listener,
            baud=baud,
            auto_press_after_s=auto_press_after_s,
        )
        self.url = f"socket://{host}:{listener.port}"


class _Listener:
    def __init__(self, host: str, port: int) -> None:
        self._socket = socket.create_server((host, port))
        self.port: int = self._socket.getsockname()[1]

    def fileno(self) -> int:
        return self._socket.fileno()

    def accept(self) -> _Client:
        return _Client(self._socket.accept()[0])

    def close(self) -> None:
        self._socket.close()


class _Client:
    def __init__(self, connection: socket.socket) -> None:
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connection

    def fileno(self) -> int:
        return self._socket.fileno()

    def receive(self) -> bytes:
        return self._socket.recv(4096)

    def send(self, data: bytes) -> int:
        return self._socket.send(data)

    def close(self) -> None:
        self._socket.close()
