"""A USB/IP server with one scripted instrument: commands in, answers out of a queue."""

import contextlib
import errno
import socket
import struct
import threading

DEVICE = bytes.fromhex("1201000200000040650720D0000101020301")
CONFIGURATION = bytes.fromhex("0902190001010080320904000001FF00000007058102400000")
TEXTS = {1: "X-Rite", 2: "DTP20", 3: "SIM00001"}
BUSID = "1-1"
GONE = -errno.ESHUTDOWN


class Peer:
    """Serves until closed; one client at a time, a new one after the old has left.

    ``answers`` maps a command to the packets it queues. ``pending`` holds reads that
    found nothing; an unlink ends them. With ``stall`` every read of endpoint 81 fails
    until its halt is cleared.
    """

    def __init__(self, answers=None):
        self.answers = answers or {}
        self.commands = []
        self.packets = []
        self.pending = []
        self.unlinks = 0
        self.configurations = 0
        self.stall = False
        self.deaf_to_unlink = False
        self.late_packet = b""
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.host, self.port = self._listener.getsockname()
        self._line = None
        self._lock = threading.RLock()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    @property
    def address(self):
        return f"usb+ip://{self.host}:{self.port}/{BUSID}"

    def send(self, packet):
        """Put a packet on endpoint 81, as an instrument does by itself."""
        with self._lock:
            self.packets.append(packet)
            self._flush()

    def unplug(self):
        """Finish every pending read and drop the client."""
        with self._lock:
            for number, _ in self.pending:
                self._return(number, GONE, b"", 0)
            self.pending.clear()
            if self._line is not None:
                with contextlib.suppress(OSError):
                    self._line.shutdown(socket.SHUT_RDWR)

    def close(self):
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self.unplug()
        self._thread.join(5.0)
        self._listener.close()

    def _serve(self):
        while True:
            try:
                line, _ = self._listener.accept()
            except OSError:
                return
            with line, contextlib.suppress(OSError, struct.error):
                self._line = line
                self._client(line.makefile("rb"))
            self._line = None

    def _client(self, stream):
        _, code, _ = struct.unpack(">HHI", stream.read(8))
        block = (
            bytes(256)
            + BUSID.encode().ljust(32, b"\0")
            + struct.pack(
                ">IIIHHHBBBBBB", 1, 2, 2, 0x0765, 0xD020, 0x100, 0, 0, 0, 1, 1, 1
            )
        )
        if code == 0x8005:
            reply = struct.pack(">HHII", 0x0111, 5, 0, 1) + block + b"\xff\0\0\0"
            self._line.sendall(reply)
            return
        if stream.read(32).rstrip(b"\0").decode() != BUSID:
            self._line.sendall(struct.pack(">HHI", 0x0111, 3, 1))
            return
        self._line.sendall(struct.pack(">HHI", 0x0111, 3, 0) + block)
        self.pending.clear()
        while head := stream.read(48):
            command, number, devid, inward, endpoint = struct.unpack(">5I", head[:20])
            assert devid == 0x10002
            with self._lock:
                if command == 2:
                    self._unlink(number, struct.unpack(">I", head[20:24])[0])
                    continue
                _, length, _, _, _, setup = struct.unpack(">IiiiI8s", head[20:])
                data = b"" if inward else stream.read(length)
                if endpoint:
                    self.pending.append((number, length))
                    self._flush()
                else:
                    self._control(number, setup, length, data)

    def _flush(self):
        while self.pending and self.stall:
            self._return(self.pending.pop(0)[0], -errno.EPIPE, b"", 0)
        while self.pending and self.packets:
            number, room = self.pending.pop(0)
            packet = self.packets.pop(0)
            status = 0 if len(packet) <= room else -errno.EOVERFLOW
            self._return(number, status, packet[:room], len(packet[:room]))

    def _control(self, number, setup, length, data):
        kind, request, value, _, _ = struct.unpack("<BBHHH", setup)
        if kind == 0x41:
            self.commands.append(data)
            self._return(number, 0, b"", length)
            self.packets += self.answers.get(data, [])
            self._flush()
            return
        status, reply = 0, b""
        if (kind, request) == (0x80, 6):
            reply = self._descriptor(value)
            status = 0 if reply else -errno.EPIPE
        elif (kind, request) == (0x80, 8):
            reply = b"\x01" if self.configurations else b"\0"
        elif (kind, request) == (0, 9):
            self.configurations += 1
        elif (kind, request) == (2, 1):
            self.stall = False
        else:
            status = -errno.EPIPE
        self._return(number, status, reply[:length], len(reply[:length]))

    def _descriptor(self, value):
        kind, index = value >> 8, value & 0xFF
        if kind == 3:
            text = TEXTS.get(index, "").encode("utf-16-le") if index else b"\x09\x04"
            return bytes([len(text) + 2, 3]) + text
        return {1: DEVICE, 2: CONFIGURATION}.get(kind, b"")

    def _unlink(self, number, victim):
        self.unlinks += 1
        if self.deaf_to_unlink:
            return
        if self.late_packet and self.pending:
            self.packets, self.late_packet = [self.late_packet], b""
            self._flush()
        found = [one for one in self.pending if one[0] == victim]
        for one in found:
            self.pending.remove(one)
        status = -errno.ECONNRESET if found else 0
        self._line.sendall(struct.pack(">5Ii24x", 4, number, 0, 0, 0, status))

    def _return(self, number, status, data, length):
        head = struct.pack(">5I5i8x", 3, number, 0, 0, 0, status, length, 0, 0, 0)
        if self._line is not None:
            with contextlib.suppress(OSError):
                self._line.sendall(head + data)
