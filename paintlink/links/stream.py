"""Serial lines: local devices, and remote ones behind a serial server."""

from __future__ import annotations

import contextlib
import errno
import os
import re
import termios
import time

import serial

from paintlink.instrument import SerialSettings
from paintlink.links.advice import FAILURES, cannot_open, lost

_URL = re.compile(r"(?:socket|rfc2217)://[^/?]+:\d{1,5}(?:[/?].*)?|loop://")
# pyserial can only wait for a fixed time without setting the port up anew.
_POLL_S = 0.05
_WRITE_TIMEOUT_S = 2.0
_CHUNK = 4096


class SerialStream:
    """The bytes of one open serial line."""

    def __init__(self, port: serial.Serial, address: str) -> None:
        self._port = port
        self._address = address

    def write(self, data: bytes) -> None:
        """Send all of ``data``.

        Raises
        ------
        LinkTimeoutError
            When the other side takes nothing for 2 s.
        LinkError
            When the line is gone.
        """
        try:
            self._port.write(data)
        except FAILURES as failure:
            raise lost(self._address, failure) from failure

    def read(self, timeout_s: float) -> bytes:
        """Return what is there, at least one byte; nothing after ``timeout_s``.

        Raises
        ------
        LinkError
            When the line is gone.
        """
        deadline = time.monotonic() + timeout_s
        try:
            if timeout_s <= 0 and self._port.is_open and not self._port.in_waiting:
                return b""
            data: bytes = self._port.read(1)
            while not data and time.monotonic() < deadline:
                data = self._port.read(1)
            if data:
                data += self._port.read(min(self._port.in_waiting, _CHUNK))
        except FAILURES as failure:
            raise lost(self._address, failure) from failure
        return data

    def close(self) -> None:
        """Give the port back; never fails."""
        if not _remote(self._address):
            with contextlib.suppress(*FAILURES):
                # Closing would wait up to 30 s for an instrument that takes nothing.
                self._port.reset_output_buffer()
        with contextlib.suppress(*FAILURES):
            self._port.close()


def open_serial(address: str, settings: SerialSettings) -> SerialStream:
    """Return an open line with nothing left in its input.

    Parameters
    ----------
    address
        A device such as ``/dev/ttyUSB0``, which is locked against other programs that
        ask for a lock, or ``socket://host:port``, ``rfc2217://host:port``, ``loop://``.

    Raises
    ------
    LinkError
        With the next step for the operator.
    """
    try:
        port = _closed_port(address, settings)
        with contextlib.ExitStack() as undo:
            undo.callback(port.close)
            port.open()
            if not _remote(address):
                _check_framing(port.fileno(), settings)
            undo.pop_all()
    except FAILURES as failure:
        raise cannot_open(address, settings, failure) from failure
    return SerialStream(port, address)


def _remote(address: str) -> bool:
    return "://" in address


def _check_framing(descriptor: int, settings: SerialSettings) -> None:
    """Raise EINVAL when the port did not take data bits and parity.

    The kernel drops what a pseudo-terminal cannot do without a word, and the C library
    tells of it only when nothing else was changed by the same call.
    """
    flags = termios.tcgetattr(descriptor)[2]
    bits = {termios.CS7: 7, termios.CS8: 8}.get(flags & termios.CSIZE)
    parity = bool(flags & termios.PARENB)
    if bits != settings.bytesize or parity != (settings.parity != "N"):
        raise termios.error(errno.EINVAL, os.strerror(errno.EINVAL))


def _closed_port(address: str, settings: SerialSettings) -> serial.Serial:
    if _remote(address) and not _URL.fullmatch(address):
        msg = f"unknown kind of address {address!r}"
        raise ValueError(msg)
    port = serial.serial_for_url(
        address,
        do_not_open=True,
        baudrate=settings.baudrate,
        bytesize=settings.bytesize,
        parity=settings.parity,
        stopbits=settings.stopbits,
        rtscts=settings.rtscts,
        timeout=_POLL_S,
        # pyserial's RFC 2217 client has no such setting, its socket has its own limit.
        write_timeout=None if address.startswith("rfc2217") else _WRITE_TIMEOUT_S,
        exclusive=None if _remote(address) else True,
    )
    port.dtr = settings.dtr
    port.rts = settings.rts
    return port
