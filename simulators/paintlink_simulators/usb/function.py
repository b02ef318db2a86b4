"""What a USB device around a simulator has to do, apart from its class."""

from __future__ import annotations

from collections import deque
from typing import ClassVar

from paintlink_simulators._simulator import LineCutError, Simulator
from paintlink_simulators.usb._requests import Setup, StallError, endpoints

PACKET = 64


class UsbFunction:
    """A simulator as the inside of a USB device; subclasses are the classes.

    Parameters
    ----------
    serial
        Serial number in the descriptor.
    zlp
        Whether an answer of n x 64 bytes is ended by an empty packet, as it must be.

    Attributes
    ----------
    cut
        A fault has ended the line: what is there still goes out, then it is gone.
    """

    DEVICE: ClassVar[bytes]
    CONFIGURATION: ClassVar[bytes]
    STRINGS: ClassVar[tuple[str, ...]] = ("paintlink sims", "MA5")
    DATA_IN: ClassVar[int] = 0x81

    def __init__(
        self, simulator: Simulator, *, serial: str = "SIM0001", zlp: bool = True
    ) -> None:
        self.simulator = simulator
        self.strings = (*self.STRINGS, serial)
        self.endpoints = endpoints(self.CONFIGURATION)
        self.cut = False
        self._zlp = zlp
        self._packets: deque[bytes] = deque()

    @property
    def empty(self) -> bool:
        """Whether nothing waits to be fetched."""
        return not self._packets

    def control(self, setup: Setup, data: bytes) -> bytes:
        """The answer to a request of its class or vendor.

        Raises
        ------
        StallError
            When it knows no such request.
        """
        raise StallError

    def out_packet(self, data: bytes) -> None:
        """Take one packet from the host."""
        self.take(self.call_feed(data))

    def in_packet(self, address: int) -> bytes | None:
        """The next packet of an endpoint; None where there is none (NAK)."""
        if address != self.DATA_IN or not self._packets:
            return None
        return self._packets.popleft()

    def call_feed(self, data: bytes) -> bytes:
        """What the simulator answers, unless a fault cuts the line meanwhile."""
        try:
            return self.simulator.feed(data)
        except LineCutError as cut:
            self.cut = True
            return cut.sent

    def poll(self) -> None:
        """Let time pass."""
        try:
            self.take(self.simulator.poll())
        except LineCutError as cut:
            self.cut = True
            self.take(cut.sent)

    def press(self) -> None:
        """Press the instrument down."""
        self.take(self.simulator.press())

    def due_at(self) -> float | None:
        """When `poll` will have something to do, by the clock of the simulator."""
        return self.simulator.due_at()

    def reset(self) -> None:
        """Begin anew, as after plugging in."""
        self._packets.clear()
        self.cut = False
        self.simulator.disconnect()

    def take(self, answer: bytes) -> None:
        """Queue what the simulator has sent, in packets."""
        if not answer:
            return
        self._packets += [
            answer[start : start + PACKET] for start in range(0, len(answer), PACKET)
        ]
        if self._zlp and len(answer) % PACKET == 0:
            self._packets.append(b"")
