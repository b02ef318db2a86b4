"""A simulated CHNSpec CR30, written from docs/wire/chn_cr30.md.

Modelled: identity, both calibrations, host and button readings, the spectral frames,
echoes of everything else, the white reference that a reading with the cap on spoils,
silence after idling. One call of `feed` is one write of the host: split and joined
frames are not answered. Open points are decided as section 6 of the page says.

Deliberately not modelled: the stream of ``BB 21``, stored jobs, the display. This
project never met the hardware.
"""

from __future__ import annotations

import itertools
import struct
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators._instrument import CommonOptions, Instrument
from paintlink_simulators._simulator import Clock, Simulator
from paintlink_simulators.paint import Panel
from paintlink_simulators.usb import Ch341Function

FRAME = 60
MARKER = 58
HOST, BUTTON = 0xFF, 0x00
ANGLES = (45.0,)
AXIS = bytes((400 // 10, 31, 10))
TRIGGER_S, CALIBRATION_S = 0.3, 1.0
SPOILED_GAIN = 1.4
CAPPED_PERCENT = 90.0
Field = tuple[int, bytes]
HARMFUL = frozenset({"echo_on"})
"""A reply equal to its request means that the command is not implemented."""
CHUNKS = {0x10: (0, 12), 0x11: (12, 24), 0x12: (24, 31)}


@dataclass(frozen=True, slots=True, kw_only=True)
class Options(CommonOptions):
    """What differs between instruments.

    Parameters
    ----------
    idle_s
        Without a frame for so long it falls silent until the line is opened anew.
    """

    model: str = "CR30"
    serial: str = "SIM0000001"
    second_id: str = "SIM0000002"
    idle_s: float | None = None

    def __post_init__(self) -> None:
        self.check("chn_cr30", model=("CR30",))


def create(panel: Panel, *, clock: Clock, seed: int = 0, **options: Any) -> ChnCr30:
    """An instrument standing on ``panel``; ``options`` are the fields of `Options`."""
    return ChnCr30(panel, clock, seed, Options(**options))


class ChnCr30(Instrument):
    """The instrument as a state machine from frames to frames; see `Simulator`."""

    __slots__ = (
        "_capped",
        "_frames",
        "_heard_at",
        "_options",
        "_percent",
    )

    def __init__(self, panel: Panel, clock: Clock, seed: int, options: Options) -> None:
        super().__init__(panel, clock, seed, options)
        self._options = options
        self._frames: deque[bytes] = deque()
        self._percent: FloatArray | None = None
        self._capped = False
        self._heard_at = clock()

    def feed(self, data: bytes) -> bytes:
        """The reply to one frame; nothing to bytes that are not exactly one."""
        if len(data) == FRAME and self._listens():
            self._frames.append(data)
        return self.poll()

    def disconnect(self) -> None:
        """Forget the frames that wait, and wake up."""
        super().disconnect()
        self._frames.clear()
        self._heard_at = self.clock()

    def _listens(self) -> bool:
        idle_s, self._heard_at = self.clock() - self._heard_at, self.clock()
        asleep = self._options.idle_s is not None and idle_s > self._options.idle_s
        if asleep:
            self._heard_at = float("-inf")
        return not asleep and self._condition == "ready"

    def _next_command(self) -> bytes | None:
        return self._frames.popleft() if self._frames else None

    def _execute(self, command: bytes) -> bytes:
        match tuple(command[:3]):
            case (0xAA, 0x0A, sub):
                return _changed(command, *self._identity(sub))
            case (0xBB, 0x10, 0x00):
                return self._work_for(
                    CALIBRATION_S, lambda: _changed(command, (6, b"\x01"))
                )
            case (0xBB, 0x11, 0x00):
                return self._work_for(
                    CALIBRATION_S, lambda: self._white(command), on_plate=True
                )
            case (0xBB, 0x01, 0x00):
                return self._work_for(TRIGGER_S, lambda: self._triggered(command))
            case (0xBB, 0x01, sub):
                return _changed(command, *self._stored(sub))
            case (0xBB, 0x13, 0x00):
                return _changed(command, (5, bytes(53)))
            case (0xAA | 0xBB, _, _):
                return _changed(command)
        return b""

    def _identity(self, sub: int) -> tuple[Field, ...]:
        options = self._options
        match sub:
            case 0x00:
                known: tuple[Field, ...] = (
                    (5, bytes.fromhex("56001903")),
                    (9, options.serial.encode("ascii")),
                    (39, options.model.encode("ascii")),
                )
            case 0x01:
                known = (19, options.second_id.encode("ascii")), (49, b"V11.3.")
            case 0x02:
                known = (5, b"0.0.20231219"), (29, b"V10.0.0.0")
            case 0x03:
                known = ((19, b"\x02"),)
            case _:
                return ()
        return ((5, bytes(50)), *known)

    def _white(self, command: bytes) -> bytes:
        self._calibrated = self._stands_on_plate()
        return _changed(command, (6, bytes([self._calibrated])))

    def _triggered(self, command: bytes) -> bytes:
        self._measure()
        return _changed(command)

    def _on_press(self) -> bytes:
        if self._condition != "ready":
            return b""
        self._measure()
        request = bytes((0xBB, 0x01, 0x09)).ljust(FRAME, b"\0")
        return _changed(request, *self._stored(0x09), marker=BUTTON)

    def _measure(self) -> None:
        self._capped = self.plate_on
        if self._capped:
            self._calibrated = False
            self._percent = np.full(31, CAPPED_PERCENT)
            return
        gain = 1.0 if self._calibrated else SPOILED_GAIN
        self._percent = 100.0 * gain * self._look(ANGLES)[0]

    def _stored(self, sub: int) -> tuple[Field, ...]:
        """What is written into the request for a part of the last reading."""
        blank = 4, bytes(53)
        if self._percent is None:
            return (blank,) if sub == 0x09 else ()
        match sub:
            case 0x09:
                return blank, (4, AXIS), (24, bytes([self._capped]))
            case 0x10 | 0x11 | 0x12:
                first, stop = CHUNKS[sub]
                return blank, (6, _floats(self._percent[first:stop]))
            case 0x13:
                return blank, (34, _floats(self._percent[:5]))
        return ()


def _floats(values: FloatArray) -> bytes:
    return struct.pack(f"<{len(values)}f", *values)


def _changed(request: bytes, *fields: Field, marker: int = HOST) -> bytes:
    """The request with the fields at their offsets, the marker and the checksum."""
    reply = bytearray(request)
    for offset, field in fields:
        reply[offset : offset + len(field)] = field
    reply[MARKER] = marker
    reply[-1] = sum(reply[:-1]) % 256
    return bytes(reply)


def usb_function(simulator: Simulator) -> Ch341Function:
    """The instrument as it appears on USB: an adapter without a serial number."""
    return Ch341Function(simulator, serial="")


def spectra(exchanges: Iterable[tuple[bytes, bytes]]) -> Iterator[FloatArray]:
    """Every spectrum that bytes hold by the grammar of section 2, in factors."""
    stream = b"".join(received for _, received in exchanges)
    chunks: dict[int, set[bytes]] = {sub: set() for sub in CHUNKS}
    for start in range(len(stream) - FRAME + 1):
        frame = stream[start : start + FRAME]
        if frame[:2] == b"\xbb\x01" and sum(frame[:-1]) % 256 == frame[-1]:
            first, stop = CHUNKS.get(frame[2], (0, 0))
            chunks.setdefault(frame[2], set()).add(frame[6 : 6 + 4 * (stop - first)])
    for parts in itertools.product(*(chunks[sub] for sub in CHUNKS)):
        yield np.frombuffer(b"".join(parts), "<f4").astype(np.float64) / 100.0
