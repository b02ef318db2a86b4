"""Simulated USB devices behind USB/IP, for a kernel or for a program."""

from __future__ import annotations

import contextlib
import errno
import socket
import struct
import threading
from collections.abc import Sequence
from functools import partial

from paintlink_simulators.usb._requests import IN, INTERFACE, Setup, split
from paintlink_simulators.usb.engine import Engine, Urb
from paintlink_simulators.usb.socket import UsbSocket

VERSION = 0x0111
REQUEST_LIST, REPLY_LIST = 0x8005, 0x0005
REQUEST_IMPORT, REPLY_IMPORT = 0x8003, 0x0003
SUBMIT, UNLINK, RETURN_SUBMIT, RETURN_UNLINK = 1, 2, 3, 4
FULL_SPEED = 2
OPERATION = struct.Struct(">HHI")
HEADER = struct.Struct(">5I")
SUBMISSION = struct.Struct(">IiiiI8s")
RESULT = struct.Struct(">iiiii8x")
UNLINKED = struct.Struct(">i24x")
PLACE = struct.Struct(">256s32sIII")


class UsbIpPort:
    """A USB/IP server on this machine for some devices.

    Parameters
    ----------
    port
        0 lets the system choose.
    """

    def __init__(
        self, sockets: Sequence[UsbSocket], *, host: str = "127.0.0.1", port: int = 0
    ) -> None:
        self._sockets = sockets
        self._listener = socket.create_server((host, port))
        self.host, self.port = self._listener.getsockname()[:2]
        self._connections: set[socket.socket] = set()
        threading.Thread(target=self._accept, daemon=True).start()

    def url(self, index: int = 0) -> str:
        """Where a device is: ``usb+ip://host:port/busid``."""
        return f"usb+ip://{self.host}:{self.port}/{self._sockets[index].busid}"

    def close(self) -> None:
        """Accept nobody any more and end every connection."""
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        for connection in list(self._connections):
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)

    def __enter__(self) -> UsbIpPort:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                connection, _ = self._listener.accept()
                self._connections.add(connection)
                threading.Thread(
                    target=self._greet, args=(connection,), daemon=True
                ).start()

    def _greet(self, connection: socket.socket) -> None:
        with contextlib.suppress(OSError, EOFError), connection:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            _, code, _ = OPERATION.unpack(receive(connection, OPERATION.size))
            if code == REQUEST_LIST:
                connection.sendall(self._list())
            elif code == REQUEST_IMPORT:
                self._import(connection)
        self._connections.discard(connection)

    def _list(self) -> bytes:
        present = [one for one in self._sockets if one.live]
        head = OPERATION.pack(VERSION, REPLY_LIST, 0)
        listed = (block(one) + _interfaces(one) for one in present)
        return head + struct.pack(">I", len(present)) + b"".join(listed)

    def _import(self, connection: socket.socket) -> None:
        wanted = receive(connection, 32).rstrip(b"\0").decode("ascii", "replace")
        for one in self._sockets:
            engine = one.live
            if one.busid == wanted and engine is not None:
                head = OPERATION.pack(VERSION, REPLY_IMPORT, 0)
                connection.sendall(head + block(one))
                serve(connection, engine)
                return
        connection.sendall(OPERATION.pack(VERSION, REPLY_IMPORT, 1))


def serve(connection: socket.socket, engine: Engine) -> None:
    """Pass requests on until the host leaves or the device is unplugged.

    The connection is shut down as soon as the device is gone: that is how a host, the
    kernel as well, learns of it.
    """
    session = _Session(connection, engine)
    engine.on_gone(lambda: _shut(connection))
    with contextlib.suppress(OSError, EOFError):
        while True:
            session.handle()


class _Session:
    def __init__(self, connection: socket.socket, engine: Engine) -> None:
        self._connection = connection
        self._engine = engine
        self._urbs: dict[int, Urb] = {}
        self._sending = threading.Lock()

    def handle(self) -> None:
        command, sequence, _, inward, endpoint = HEADER.unpack(
            receive(self._connection, HEADER.size)
        )
        body = receive(self._connection, SUBMISSION.size)
        if command == UNLINK:
            self._unlink(sequence, struct.unpack_from(">I", body)[0])
        elif command == SUBMIT:
            self._submit(sequence, endpoint | (IN if inward else 0), body)
        else:
            raise EOFError

    def _submit(self, sequence: int, address: int, body: bytes) -> None:
        _, length, _, _, _, setup = SUBMISSION.unpack(body)
        inward = bool(address & IN)
        data = b"" if inward else receive(self._connection, length)
        control = not address & 0x7F
        urb = Urb(
            0 if control else address,
            partial(self._finished, sequence, inward, length),
            setup=Setup.parse(setup) if control else None,
            data=data,
            length=length,
        )
        self._urbs[sequence] = urb
        self._engine.submit(urb)

    def _finished(self, sequence: int, inward: bool, length: int, urb: Urb) -> None:
        status = urb.status or 0
        done = len(urb.received) if inward else length * (status == 0)
        data = bytes(urb.received) if inward else b""
        self._send(
            HEADER.pack(RETURN_SUBMIT, sequence, 0, 0, 0)
            + RESULT.pack(status, done, 0, 0, 0)
            + data
        )
        # Not before: an unlink that no longer finds it is answered after it, or a
        # kernel takes the request back and then cuts the line over its answer.
        self._urbs.pop(sequence, None)

    def _unlink(self, sequence: int, victim: int) -> None:
        urb = self._urbs.get(victim)
        taken = urb is not None and self._engine.unlink(urb)
        if taken:
            self._urbs.pop(victim)
        status = -errno.ECONNRESET if taken else 0
        head = HEADER.pack(RETURN_UNLINK, sequence, 0, 0, 0)
        self._send(head + UNLINKED.pack(status))

    def _send(self, message: bytes) -> None:
        with self._sending, contextlib.suppress(OSError):
            self._connection.sendall(message)


def block(device: UsbSocket) -> bytes:
    """The 312 bytes that describe a device."""
    raw, configuration = device.function.DEVICE, device.function.CONFIGURATION
    vendor, product, release = struct.unpack_from("<HHH", raw, 8)
    path = f"/sys/devices/simulated/usb1/{device.busid}"
    return (
        PLACE.pack(path.encode(), device.busid.encode(), 1, device.address, FULL_SPEED)
        + struct.pack(">HHH", vendor, product, release)
        + bytes((*raw[4:7], configuration[5], raw[17], configuration[4]))
    )


def receive(connection: socket.socket, size: int) -> bytes:
    """Exactly so many bytes.

    Raises
    ------
    EOFError
        When the other end leaves before.
    """
    data = bytearray()
    while len(data) < size:
        part = connection.recv(size - len(data))
        if not part:
            raise EOFError
        data += part
    return bytes(data)


def _interfaces(device: UsbSocket) -> bytes:
    found = [one for one in split(device.function.CONFIGURATION) if one[1] == INTERFACE]
    return b"".join(bytes((*one[5:8], 0)) for one in found)


def _shut(connection: socket.socket) -> None:
    with contextlib.suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
