"""One USB device of a USB/IP server: transfers with deadlines, without the kernel."""

from __future__ import annotations

import contextlib
import errno
import os
import socket
import struct
import time

import usb.core

from paintlink.errors import LinkError
from paintlink.links import usbip_wire as wire

CONNECT_S = 3.0
ANSWER_S = 3.0
_LARGEST = 1 << 20
_ENDED = (-errno.ECONNRESET, -errno.ENOENT)


class UsbIpClient:
    """An imported device.

    Raises
    ------
    LinkError
        When the server cannot be reached or does not export the device.
    """

    def __init__(self, host: str, port: int, busid: str) -> None:
        self._place = f"usb+ip://{host}:{port}/{busid}"
        self._sequence = 0
        self._socket = _connect(host, port, self._place)
        try:
            self.device = self._import(busid)
        except OSError as failure:
            self.close()
            msg = f"{self._place}: the server broke off ({failure}): start it again"
            raise LinkError(msg) from failure
        except LinkError as refusal:
            self.close()
            names = ", ".join(one.busid for one in exported(host, port)) or "nothing"
            msg = f"{refusal}; it exports {names}"
            raise LinkError(msg) from refusal

    def transfer(
        self,
        endpoint: int,
        *,
        length: int,
        timeout_ms: int,
        setup: bytes = bytes(8),
        data: bytes = b"",
    ) -> tuple[int, bytes]:
        """Return how many bytes went, and those that came.

        Parameters
        ----------
        timeout_ms
            0 waits for ever, as everywhere in pyusb.

        Raises
        ------
        USBTimeoutError
            When nothing came in time; the transfer was taken back.
        USBError
            With the errno that libusb gives for the same cause.
        """
        number = self._next()
        try:
            self._socket.settimeout(ANSWER_S)
            self._socket.sendall(
                wire.submit(
                    number,
                    self.device.devid,
                    endpoint,
                    length=length,
                    setup=setup,
                    data=data,
                )
            )
            returned, came = self._await(number, endpoint, timeout_ms)
        except (OSError, struct.error) as failure:
            self.close()
            raise usb_error(errno.ENODEV) from failure
        if returned.status in _ENDED and not came:
            raise usb_error(errno.ETIMEDOUT)
        if returned.status and returned.status not in _ENDED:
            code = -returned.status
            raise usb_error(errno.ENODEV if code == errno.ESHUTDOWN else code)
        return returned.length, came

    def close(self) -> None:
        """Give the device back to the server; never fails."""
        with contextlib.suppress(OSError):
            self._socket.close()

    def _import(self, busid: str) -> wire.Exported:
        self._socket.sendall(wire.import_request(busid))
        _, code, status = wire.OPERATION.unpack(self._exactly(wire.OPERATION_SIZE))
        if code != wire.IMPORT_REPLY or status:
            msg = f"{self._place}: the server does not export this device"
            raise LinkError(msg)
        return wire.parse_device(self._exactly(wire.DEVICE_SIZE))

    def _await(
        self, number: int, endpoint: int, timeout_ms: int
    ) -> tuple[wire.Returned, bytes]:
        """The answer to transfer ``number``, or to taking it back after the time."""
        if not self._readable(timeout_ms / 1000.0 if timeout_ms else None):
            victim = wire.unlink(self._next(), self.device.devid, number)
            self._socket.sendall(victim)
        deadline = time.monotonic() + ANSWER_S if timeout_ms else None
        while True:
            self._socket.settimeout(
                None if deadline is None else max(0.001, deadline - time.monotonic())
            )
            returned = wire.parse_return(self._exactly(wire.URB_SIZE))
            data = self._data(returned, endpoint)
            if returned.command == wire.RET_SUBMIT and returned.sequence == number:
                self._forget_unlink(number)
                return returned, data
            if returned.command == wire.RET_UNLINK and returned.status in _ENDED:
                return returned._replace(length=0), b""

    def _forget_unlink(self, number: int) -> None:
        """Read the answer to an unlink that came too late for its transfer."""
        if self._sequence != number:
            self._exactly(wire.URB_SIZE)

    def _data(self, returned: wire.Returned, endpoint: int) -> bytes:
        inward = returned.command == wire.RET_SUBMIT and endpoint & 0x80
        if inward and not 0 <= returned.length <= _LARGEST:
            raise OSError(errno.EPROTO, os.strerror(errno.EPROTO))
        return self._exactly(returned.length) if inward and returned.length else b""

    def _readable(self, timeout_s: float | None) -> bool:
        self._socket.settimeout(timeout_s)
        try:
            first = self._socket.recv(1, socket.MSG_PEEK)
        except TimeoutError:
            return False
        if not first:
            raise ConnectionResetError(errno.ECONNRESET, "the server closed the line")
        return True

    def _exactly(self, size: int) -> bytes:
        data = b""
        while len(data) < size:
            piece = self._socket.recv(size - len(data))
            if not piece:
                msg = "the server closed the line"
                raise ConnectionResetError(errno.ECONNRESET, msg)
            data += piece
        return data

    def _next(self) -> int:
        self._sequence = self._sequence % 0x7FFFFFFF + 1
        return self._sequence


def exported(host: str, port: int) -> tuple[wire.Exported, ...]:
    """Return what a server offers; nothing when it cannot be asked."""
    found = []
    try:
        with _connect(host, port, host) as line, line.makefile("rb") as answer:
            line.sendall(wire.list_request())
            answer.read(wire.OPERATION_SIZE)
            for _ in range(min(int.from_bytes(answer.read(4), "big"), 1000)):
                found.append(wire.parse_device(answer.read(wire.DEVICE_SIZE)))
                answer.read(4 * found[-1].interfaces)
    except (LinkError, OSError, struct.error):
        return tuple(found)
    return tuple(found)


def usb_error(code: int) -> usb.core.USBError:
    """Return the error pyusb raises for an errno."""
    text = os.strerror(code)
    if code == errno.ETIMEDOUT:
        return usb.core.USBTimeoutError(text, errno=code)
    return usb.core.USBError(text, errno=code)


def _connect(host: str, port: int, place: str) -> socket.socket:
    try:
        line = socket.create_connection((host, port), timeout=CONNECT_S)
    except (OSError, UnicodeError) as failure:
        msg = (
            f"{place} cannot be reached ({failure}): check host and port, and that the "
            "USB/IP server runs"
        )
        raise LinkError(msg) from failure
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return line
