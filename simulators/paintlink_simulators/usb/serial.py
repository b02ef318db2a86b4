"""USB devices that hold a serial line: CDC-ACM, FTDI and CH34x."""

from __future__ import annotations

import struct
from dataclasses import replace
from typing import Any, ClassVar

from paintlink_simulators._simulator import Simulator, earlier
from paintlink_simulators._uart import LineSettings, heard
from paintlink_simulators.ports._pacer import Pacer
from paintlink_simulators.usb._requests import Setup, StallError
from paintlink_simulators.usb.function import PACKET, UsbFunction


class SerialFunction(UsbFunction):
    """An instrument on the serial line of an adapter.

    Parameters
    ----------
    line
        How the instrument's end of the line is set: it hears garbage from a host that
        is set otherwise, and sends it garbage. None hears everything.
    paced
        Whether answers take the time they take at the baud rate of ``line``.

    Attributes
    ----------
    host_line
        How the host has set the line.
    dtr, rts
        The modem lines of the host.
    breaks
        How often the host has sent a break.
    """

    def __init__(
        self,
        simulator: Simulator,
        *,
        serial: str = "SIM0001",
        zlp: bool = True,
        line: LineSettings | None = None,
        paced: bool = False,
    ) -> None:
        super().__init__(simulator, serial=serial, zlp=zlp)
        self.host_line = LineSettings()
        self.dtr = self.rts = False
        self.breaks = 0
        self._line = line
        self._pacer = Pacer(int(line.baudrate) if line and paced else None)
        self._held = b""
        self._ready = b""
        self._end_due = False

    @property
    def empty(self) -> bool:
        """Whether nothing waits to be fetched."""
        return not (self._held or self._ready)

    def out_packet(self, data: bytes) -> None:
        """Give the instrument what it hears of a packet."""
        if self._line is not None:
            data = heard(data, self.host_line, self._line)
        if data:
            super().out_packet(data)

    def take(self, answer: bytes) -> None:
        """Queue what the host hears of an answer."""
        if self._line is not None:
            answer = heard(answer, self._line, self.host_line)
        if answer and not self._held:
            self._pacer.start(self.simulator.clock())
        self._held += answer
        self._pass_on()

    def poll(self) -> None:
        """Let time pass, on the line as well."""
        super().poll()
        self._pass_on()

    def due_at(self) -> float | None:
        """When the instrument or the next character is due."""
        return self.simulator.clock() if self._held else super().due_at()

    def reset(self) -> None:
        """Begin anew, as after plugging in."""
        super().reset()
        self._held = self._ready = b""
        self._end_due = False

    def in_packet(self, address: int) -> bytes | None:
        """The next characters; an empty packet behind a last full one."""
        if address != self.DATA_IN or not (self._ready or self._end_due):
            return None
        packet, self._ready = self._ready[:PACKET], self._ready[PACKET:]
        self._end_due = self._zlp and len(packet) == PACKET and not self._ready
        return packet

    def _pass_on(self) -> None:
        count = max(self._pacer.allowance(self.simulator.clock()), 0)
        passed, self._held = self._held[:count], self._held[count:]
        self._pacer.sent(len(passed))
        self._ready += passed


class AcmFunction(SerialFunction):
    """A CDC-ACM device: Linux makes it /dev/ttyACM*."""

    DEVICE = bytes.fromhex("120100020200004009120200000101020301")
    CONFIGURATION = bytes.fromhex(
        "0902430002010080320904000001020201000524001001052401000104240206"
        "0524060001070583031000200904010002"
        "0A0000000705020240000007058102400000"
    )
    PARITIES: ClassVar[str] = "NOEMS"

    def control(self, setup: Setup, data: bytes) -> bytes:
        """Line coding, modem lines and break."""
        match (setup.kind, setup.request):
            case (0x21, 0x20):
                baud, stop, parity, bits = struct.unpack("<IBBB", data)
                self.host_line = LineSettings(
                    float(baud), bits, self.PARITIES[parity], 1.0 + stop / 2.0
                )
            case (0xA1, 0x21):
                return self._coding()
            case (0x21, 0x22):
                self.dtr, self.rts = bool(setup.value & 1), bool(setup.value & 2)
            case (0x21, 0x23):
                self.breaks += bool(setup.value)
            case _:
                raise StallError
        return b""

    def _coding(self) -> bytes:
        line = self.host_line
        return struct.pack(
            "<IBBB",
            int(line.baudrate),
            int(2 * line.stopbits - 2),
            self.PARITIES.index(line.parity),
            line.bytesize,
        )


class FtdiFunction(SerialFunction):
    """An FT232 adapter: Linux makes it /dev/ttyUSB*."""

    DEVICE = bytes.fromhex("120100020000004003040160000601020301")
    CONFIGURATION = bytes.fromhex(
        "0902200001010080320904000002FFFFFF000705810240000007050202400000"
    )
    STATUS: ClassVar[bytes] = bytes((0x31, 0x60))
    EIGHTHS: ClassVar[tuple[int, ...]] = (0, 4, 2, 1, 3, 5, 6, 7)
    LAZY_S: ClassVar[float] = 0.0
    """The shortest time between two packets that hold the status alone."""
    UNREAD_S: ClassVar[float] = 0.1
    """A packet that is overdue for so long waits for a host that reads."""

    def __init__(self, simulator: Simulator, **options: Any) -> None:
        super().__init__(simulator, **options)
        self._latency_s = 0.016
        self._sent_at = self.simulator.clock()

    def control(self, setup: Setup, data: bytes) -> bytes:
        """Requests of the adapter; the EEPROM is empty."""
        match setup.request:
            case 0 | 2:
                pass
            case 1:
                self._modem(setup.value)
            case 3:
                self._set_baud(setup.value | (setup.target & 1) << 16)
            case 4:
                self._set_form(setup.value)
            case 5:
                return self.STATUS
            case 9:
                self._latency_s = setup.value / 1000.0
            case 10:
                return bytes([int(1000 * self._latency_s)])
            case 0x90:
                return b"\xff\xff"
            case _:
                raise StallError
        return b""

    def in_packet(self, address: int) -> bytes | None:
        """Two bytes of status and the next characters, bundled as the latency says."""
        if address != self.DATA_IN:
            return None
        now = self.simulator.clock()
        room = PACKET - len(self.STATUS)
        patience_s = self._latency_s if self._ready else self._status_s
        if len(self._ready) < room and now - self._sent_at < patience_s:
            return None
        self._sent_at = now
        characters, self._ready = self._ready[:room], self._ready[room:]
        return self.STATUS + characters

    def due_at(self) -> float | None:
        """Soon at the latest: the adapter sends its status again and again."""
        patience_s = self._latency_s if self._ready else self._status_s
        due_at = self._sent_at + patience_s
        unread = self.simulator.clock() > due_at + self.UNREAD_S
        return super().due_at() if unread else earlier(super().due_at(), due_at)

    @property
    def _status_s(self) -> float:
        return max(self._latency_s, self.LAZY_S)

    def _modem(self, value: int) -> None:
        if value & 0x100:
            self.dtr = bool(value & 1)
        if value & 0x200:
            self.rts = bool(value & 2)

    def _set_baud(self, value: int) -> None:
        eighths = self.EIGHTHS[value >> 14 & 3 | (value >> 16 & 1) << 2]
        divisor = (value & 0x3FFF) + eighths / 8.0
        self.host_line = replace(
            self.host_line, baudrate=3_000_000.0 / max(divisor, 1.0)
        )

    def _set_form(self, value: int) -> None:
        self.host_line = replace(
            self.host_line,
            bytesize=value & 0xF,
            parity="NOEMS"[value >> 8 & 7],
            stopbits=1.0 + (value >> 11 & 3) / 2.0,
        )
        self.breaks += value >> 14 & 1


class Ch341Function(SerialFunction):
    """A CH34x adapter, as inside a CR30: Linux makes it /dev/ttyUSB*."""

    DEVICE = bytes.fromhex("12010002FF000040861A2375640201020301")
    CONFIGURATION = bytes.fromhex(
        "0902270001010080320904000003FF010200070582024000000705020240000007058103080001"
    )
    STRINGS = ("wch.cn", "CH554_CDC")
    DATA_IN = 0x82

    def control(self, setup: Setup, data: bytes) -> bytes:
        """Registers of the adapter: version, line, modem lines."""
        match setup.request:
            case 0x5F:
                return b"\x31\x00"
            case 0x95:
                return b"\xff\xee" if setup.value == 0x0706 else b"\x00\x00"
            case 0x9A | 0xA1:
                self._write(setup.value, setup.target)
            case 0xA4:
                state = ~setup.value
                self.dtr, self.rts = bool(state & 0x20), bool(state & 0x40)
            case _:
                raise StallError
        return b""

    def _write(self, register: int, value: int) -> None:
        if register == 0x1312:
            scale = 12 - 3 * (value & 3) - (value >> 2 & 1)
            baud = 48_000_000.0 / ((1 << scale) * (256 - (value >> 8)))
            self.host_line = replace(self.host_line, baudrate=baud)
        elif register == 0x2518:
            parity = "OEMS"[value >> 4 & 3] if value & 8 else "N"
            self.host_line = replace(
                self.host_line,
                bytesize=5 + (value & 3),
                parity=parity,
                stopbits=1.0 + (value >> 2 & 1),
            )
