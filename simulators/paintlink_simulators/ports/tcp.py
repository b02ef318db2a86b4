"""A simulator behind a TCP port on this machine, as a serial device server has it."""

from __future__ import annotations

import socket
from collections.abc import Callable

from paintlink_simulators._simulator import Simulator
from paintlink_simulators._uart import LineSettings
from paintlink_simulators.ports._line import Line
from paintlink_simulators.ports.server import Server


class TcpPort(Server):
    """A simulator at ``url``, for one client at a time; others are turned away.

    Parameters
    ----------
    port
        0 lets the system choose.
    """

    SCHEME = "socket"

    def __init__(
        self,
        simulator: Simulator,
        *,
        host: str = "127.0.0.1",
        port: int = 0,
        baud: int | None = None,
        auto_press_after_s: float | None = None,
        line: LineSettings | None = None,
    ) -> None:
        listener = Listener(host, port, self._line_of)
        super().__init__(
            simulator,
            listener=listener,
            baud=baud,
            auto_press_after_s=auto_press_after_s,
            line=line,
        )
        self.url = f"{self.SCHEME}://{host}:{listener.port}"

    def _line_of(self, connection: socket.socket) -> Line:
        return Client(connection)


class Listener:
    """A TCP port that makes a line of each connection."""

    def __init__(
        self, host: str, port: int, line_of: Callable[[socket.socket], Line]
    ) -> None:
        self._line_of = line_of
        self._socket = socket.create_server((host, port))
        self.port: int = self._socket.getsockname()[1]

    def fileno(self) -> int:
        """The descriptor to wait on."""
        return self._socket.fileno()

    def accept(self) -> Line:
        """The line to the client that has connected."""
        connection = self._socket.accept()[0]
        try:
            return self._line_of(connection)
        except OSError:
            connection.close()
            raise

    def close(self) -> None:
        """Accept nobody any more."""
        self._socket.close()


class Client:
    """A connection that carries bytes and nothing else."""

    def __init__(self, connection: socket.socket) -> None:
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connection

    def fileno(self) -> int:
        """The descriptor to wait on."""
        return self._socket.fileno()

    def receive(self) -> bytes:
        """What has arrived."""
        return self._socket.recv(4096)

    def send(self, data: bytes) -> int:
        """How many of the bytes were taken."""
        return self._socket.send(data)

    def host_line(self) -> LineSettings | None:
        """None: it cannot be seen."""
        return None

    def close(self) -> None:
        """End the connection."""
        self._socket.close()
