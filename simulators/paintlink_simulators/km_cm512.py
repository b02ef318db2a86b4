"""A simulated Konica Minolta CM-512m3(A), written from docs/wire/km_cm512.md.

Modelled: identification, status, both calibrations, the white plate's values in both
directions, the measurement with its continuations, type-ahead. Open points are decided
as section 8 of the page says.

Deliberately not modelled: parity and baud rate, the display and the keys, readings
stored in the instrument. Never met real hardware.
"""

from __future__ import annotations

import math
import re
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from paintlink.model import FloatArray
from paintlink_simulators._instrument import CommonOptions, Instrument
from paintlink_simulators._simulator import Clock, Simulator
from paintlink_simulators.paint import Panel
from paintlink_simulators.usb import FtdiFunction

ANGLES = (25.0, 45.0, 75.0)
END = b"\r"
LARGEST = 999.99
PLATE_BANDS = 16
UZC_S, CAL_S, MES_S = 1.5, 2.5, 3.0
PLATE = tuple(tuple(90.0 + 0.1 * band for band in range(PLATE_BANDS)) for _ in ANGLES)
REST = "".join(",000.00" for _ in range(7)) + "   "
WRITTEN = re.compile(rb"OK\d\d((?:,\d{3}\.\d{2}){31})")
VALUE = re.compile(r"\d{3}\.\d{2}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Options(CommonOptions):
    """What differs between instruments.

    Parameters
    ----------
    identity
        The fields of its answer to ``IDR``, behind the code.
    zeroed
        Whether the zero calibration was done.
    """

    model: str = "CM-512m3A"
    identity: tuple[str, ...] = ("CM-512m3A", "1.10", "12345678")
    zeroed: bool = True

    def __post_init__(self) -> None:
        self.check("km_cm512", model=("CM-512m3A", "CM-512m3"))


def create(panel: Panel, *, clock: Clock, seed: int = 0, **options: Any) -> KmCm512:
    """An instrument standing on ``panel``; ``options`` are the fields of `Options`."""
    return KmCm512(panel, clock, seed, Options(**options))


class KmCm512(Instrument):
    """The instrument as a state machine from bytes to bytes; see `Simulator`."""

    __slots__ = (
        "_count",
        "_new_plate",
        "_options",
        "_plate",
        "_waiting",
        "_zeroed",
    )

    def __init__(self, panel: Panel, clock: Clock, seed: int, options: Options) -> None:
        super().__init__(panel, clock, seed, options)
        self._options = options
        self._zeroed = options.zeroed
        self._plate = PLATE
        self._new_plate: list[tuple[float, ...]] = []
        self._count = 0
        self._waiting: deque[bytes] = deque()

    def disconnect(self) -> None:
        """Forget the unfinished command and every continuation."""
        super().disconnect()
        self._waiting.clear()
        self._new_plate.clear()

    def _execute(self, command: bytes) -> bytes:
        name, *parameters = command.replace(b"\n", b"").decode("latin-1").split(",")
        if name == "&" and self._new_plate and parameters:
            return self._plate_part(parameters)
        self._new_plate.clear()
        if name == "&":
            return self._next_reply(parameters)
        self._waiting.clear()
        if name == "CDS":
            return self._plate_part(parameters)
        return self._plain(name) if not parameters else _reply("ER17")

    def _plain(self, name: str) -> bytes:
        match name:
            case "":
                return b""
            case "IDR":
                model, *rest = self._options.identity
                return _reply("OK00", self._options.model or model, *rest)
            case "STR":
                lamp, white = self._condition == "warming", self._calibrated
                return _reply("OK00", str(int(lamp)), str(int(white)))
            case "UZC":
                return self._work_for(UZC_S, self._zero)
            case "CAL":
                return self._start_white()
            case "CDR":
                return self._first_of(
                    _reply("OK00", *map(_value, row)) for row in self._plate
                )
            case "MES":
                return self._start_measuring()
        return _reply("ER00")

    def _zero(self) -> bytes:
        self._zeroed = True
        return _reply("OK00")

    def _start_white(self) -> bytes:
        if not self._zeroed:
            return _reply("ER01")
        return self._work_for(CAL_S, self._white, on_plate=True)

    def _white(self) -> bytes:
        self._calibrated = self._stands_on_plate()
        return _reply("OK00" if self._calibrated else "ER10")

    def _start_measuring(self) -> bytes:
        refusals = {"warming": "ER02", "battery_low": "ER30"}
        if not (self._zeroed and self._calibrated):
            return _reply("ER01")
        if self._condition in refusals:
            return _reply(refusals[self._condition])
        return self._work_for(MES_S, self._measured)

    def _measured(self) -> bytes:
        self._count = self._count % 99999 + 1
        full = self._condition == "memory_full"
        replies = [_reply("OK02" if full else "OK00", f"{self._count:05d}")]
        for factors in self._look(ANGLES):
            spectrum = _reply("OK00", *map(_value, (100.0 * factors).tolist()))
            replies += [spectrum, b"OK00" + REST.encode("ascii") + END]
        return self._first_of(replies)

    def _first_of(self, replies: Iterable[bytes]) -> bytes:
        self._waiting.extend(replies)
        return self._waiting.popleft()

    def _next_reply(self, parameters: list[str]) -> bytes:
        if parameters or not self._waiting:
            return _reply("ER00")
        return self._waiting.popleft()

    def _plate_part(self, parameters: list[str]) -> bytes:
        readable = all(map(VALUE.fullmatch, parameters))
        if not readable or len(parameters) != PLATE_BANDS:
            self._new_plate.clear()
            return _reply("ER17")
        self._new_plate.append(tuple(map(float, parameters)))
        if len(self._new_plate) < len(ANGLES):
            return b"&" + END
        self._plate = tuple(self._new_plate)
        self._new_plate.clear()
        return _reply("OK00")


def _value(percent: float) -> str:
    if math.isnan(percent):
        return "***.**"
    return f"{min(max(percent, 0.0), LARGEST):06.2f}"


def _reply(code: str, *fields: str) -> bytes:
    return ",".join((code, *fields)).encode("ascii") + END


def usb_function(simulator: Simulator) -> FtdiFunction:
    """The instrument on a USB adapter."""
    return FtdiFunction(simulator, serial="SIM-CM")


def spectra(exchanges: Iterable[tuple[bytes, bytes]]) -> Iterator[FloatArray]:
    """Every spectrum that bytes hold by the grammar of section 5, in factors."""
    answers = [received for _, received in exchanges]
    # A reply may come in two answers; what stands before a command was sent is dropped.
    pieces = [b"".join(answers), *answers]
    for reply in chain.from_iterable(piece.split(END) for piece in pieces):
        if match := WRITTEN.fullmatch(reply.replace(b"\n", b"").strip()):
            fields = match[1].decode("ascii").split(",")[1:]
            yield np.array(fields, dtype=np.float64) / 100.0
