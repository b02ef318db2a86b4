"""What a serial receiver makes of a sender that is set another way."""

from __future__ import annotations

import math
from dataclasses import dataclass

TOLERANCE = 0.02  # of the baud rate, well inside what half a bit in ten allows


@dataclass(frozen=True, slots=True)
class LineSettings:
    """How one end of a serial line is set; parity N, E, O, M or S."""

    baudrate: float = 9600.0
    bytesize: int = 8
    parity: str = "N"
    stopbits: float = 1.0

    def agrees(self, other: LineSettings) -> bool:
        """Whether the two ends understand each other."""
        same_form = (self.bytesize, self.parity) == (other.bytesize, other.parity)
        apart = abs(self.baudrate - other.baudrate) / self.baudrate
        return same_form and apart <= TOLERANCE


def heard(data: bytes, sender: LineSettings, receiver: LineSettings) -> bytes:
    """What arrives of ``data``: a receiver samples each bit in its middle.

    It begins a character at every falling edge and takes it as it is, framing and
    parity errors included.
    """
    if sender.agrees(receiver):
        return bytes(byte & (0xFF >> (8 - sender.bytesize)) for byte in data)
    wire = [level for byte in data for level in _levels(byte, sender)]
    sample = sender.baudrate / receiver.baudrate  # bits of the sender per bit
    received = bytearray()
    at = 0
    while (edge := _falling_edge(wire, at)) is not None:
        if _level(wire, edge + 0.5 * sample):
            at = edge + 1
            continue
        bits = [
            _level(wire, edge + (place + 1.5) * sample)
            for place in range(receiver.bytesize)
        ]
        received.append(sum(bit << place for place, bit in enumerate(bits)))
        length = 1.5 + receiver.bytesize + (receiver.parity != "N")
        at = math.ceil(edge + length * sample)
    return bytes(received)


def _levels(byte: int, settings: LineSettings) -> list[int]:
    """Start bit, data, parity, stop bits; 1 is the idle line."""
    bits = [byte >> place & 1 for place in range(settings.bytesize)]
    odd = sum(bits) % 2
    parity = {"N": [], "E": [odd], "O": [1 - odd], "M": [1], "S": [0]}
    return [0, *bits, *parity[settings.parity], *[1] * math.ceil(settings.stopbits)]


def _falling_edge(wire: list[int], start: int) -> int | None:
    for place in range(start, len(wire)):
        if not wire[place] and (place == 0 or wire[place - 1]):
            return place
    return None


def _level(wire: list[int], place: float) -> int:
    return wire[int(place)] if place < len(wire) else 1
