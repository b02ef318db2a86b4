"""A simulator behind a serial device server that takes settings, by RFC 2217."""

from __future__ import annotations

import socket
from collections.abc import Mapping
from typing import Any

import serial.rfc2217

from paintlink_simulators._uart import LineSettings
from paintlink_simulators.ports._line import Line
from paintlink_simulators.ports.tcp import Client, TcpPort


class Rfc2217Port(TcpPort):
    """A simulator at ``url``, whose line a client sets as if it were its own."""

    SCHEME = "rfc2217"

    def _line_of(self, connection: socket.socket) -> Line:
        return _NegotiatingClient(connection)


class RemoteLine:
    """What pyserial's side of a server asks of a serial port."""

    def __init__(self) -> None:
        self.baudrate, self.bytesize, self.parity, self.stopbits = 9600, 8, "N", 1.0
        self.xonxoff = self.rtscts = self.break_condition = False
        self.dtr = self.rts = self.cts = self.dsr = self.cd = True
        self.ri = False

    def get_settings(self) -> Mapping[str, object]:
        """Everything a change is noticed by."""
        return dict(vars(self))

    def reset_input_buffer(self) -> None:
        """Nothing is kept."""

    def reset_output_buffer(self) -> None:
        """Nothing is kept."""


class _NegotiatingClient(Client):
    def __init__(self, connection: socket.socket) -> None:
        super().__init__(connection)
        self._line = RemoteLine()
        self._unsent = b""
        # It asks for less of both than its types say.
        port: Any = self._line
        connection_side: Any = self
        self._manager = serial.rfc2217.PortManager(port, connection_side)

    def write(self, data: bytes) -> None:
        """Send an answer of the negotiation; `serial.rfc2217` calls it."""
        self._unsent += data
        self._push()

    def receive(self) -> bytes:
        """What has arrived, the negotiation taken out."""
        data = super().receive()
        if not data:
            return data
        self._manager.check_modem_lines()
        characters = b"".join(self._manager.filter(data))
        if not characters:
            raise BlockingIOError
        return characters

    def send(self, data: bytes) -> int:
        """How many characters were taken; they are escaped on the way."""
        self._push()
        if self._unsent:
            raise BlockingIOError
        self._unsent = b"".join(self._manager.escape(data))
        self._push()
        return len(data)

    def host_line(self) -> LineSettings:
        """How the client has set the line."""
        line = self._line
        return LineSettings(
            float(line.baudrate), line.bytesize, line.parity, float(line.stopbits)
        )

    def _push(self) -> None:
        try:
            sent = super().send(self._unsent) if self._unsent else 0
        except BlockingIOError:
            return
        self._unsent = self._unsent[sent:]
