"""Devices with endpoints of their own: the reference device, and the X-Rite DTP20."""

from __future__ import annotations

import struct
from typing import ClassVar

from paintlink_simulators._simulator import Simulator
from paintlink_simulators.usb._requests import Setup, StallError
from paintlink_simulators.usb.function import UsbFunction

PRESSED = b"\x01\x00"


class VendorFunction(UsbFunction):
    """Bulk out 01, bulk in 81, the button on interrupt in 82, a status request.

    It is no real instrument: it has everything in it that can go wrong on a bus, so
    that the fakes and the kernel can be compared on it.
    """

    DEVICE = bytes.fromhex("120100020000004009120100000101020301")
    CONFIGURATION = bytes.fromhex(
        "0902270001010080320904000003FF00000007050102400000070581024000000705820308000A"
    )
    BUTTON_IN: ClassVar[int] = 0x82

    def __init__(
        self, simulator: Simulator, *, serial: str = "SIM0001", zlp: bool = True
    ) -> None:
        super().__init__(simulator, serial=serial, zlp=zlp)
        self._presses = 0
        self._count = 0

    def control(self, setup: Setup, data: bytes) -> bytes:
        """Eight bytes of status: 5, 1 and how many writes it took; or a reset."""
        match (setup.kind, setup.request):
            case (0xC0, 0x10):
                return struct.pack("<HHI", 5, 1, self._count)
            case (0x40, 0x11):
                self.reset()
                return b""
        raise StallError

    def out_packet(self, data: bytes) -> None:
        """Give the packet to the instrument and count it."""
        self._count += 1
        super().out_packet(data)

    def in_packet(self, address: int) -> bytes | None:
        """A packet of the instrument, or of its button."""
        if address == self.BUTTON_IN and self._presses:
            self._presses -= 1
            return PRESSED
        return super().in_packet(address)

    def press(self) -> None:
        """Press the instrument; the button has an endpoint of its own."""
        self._presses += 1
        super().press()


class RciFunction(UsbFunction):
    """The X-Rite DTP20: commands in control transfers, answers on endpoint 81."""

    DEVICE = bytes.fromhex("1201000200000040650720D0000101020301")
    CONFIGURATION = bytes.fromhex("0902190001010080320904000001FF00000007058102400000")
    STRINGS = ("X-Rite", "DTP20")

    def control(self, setup: Setup, data: bytes) -> bytes:
        """Nothing to a command: what it says goes to the instrument."""
        if (setup.kind, setup.request) != (0x41, 0):
            raise StallError
        self.take(self.call_feed(data))
        return b""
