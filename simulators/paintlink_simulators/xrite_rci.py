"""Simulated X-Rite instruments of the RCI dialect, from docs/wire/xrite_rci.md.

Modelled: ping, identity, configuration, both generations of codes, errors that last
until ``CE``, calibration, host and button readings, the read-out of each model, stored
readings and the binary spectrum of the DTP20. Open points are decided as section 10 of
the page says.

Deliberately not modelled: strips and charts, density, other illuminants than D65/10,
the baud rate, factory calibration. Never met real hardware.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from paintlink.color import lab_to_xyz, reflectance_to_lab, white
from paintlink.model import FloatArray
from paintlink_simulators._instrument import CommonOptions, Instrument
from paintlink_simulators._rci_models import BUSY, MODELS, Failure
from paintlink_simulators._simulator import Clock, Simulator
from paintlink_simulators.paint import WAVELENGTHS_NM, Panel
from paintlink_simulators.usb import RciFunction

ANGLES = (45.0,)
COMMAND = re.compile(r"([0-9A-F]*)([A-Z]{2})")
BINARY_BYTES = 62
SEPARATORS = (" ", ",", "\t", "\r", "\r\n", "\n")
DELIMITERS = ("\r", "\r\n", "\n")
SEPARATOR, DELIMITER, ECHO, DECIMALS = 0x07, 0x08, 0x09, 0x0A
ILLUMINANT, DATA_TYPE, NUMBER_FORMAT = 0x16, 0x18, 0x1B
FACTORY = {
    **{SEPARATOR: 1, DELIMITER: 1, ECHO: 0, DECIMALS: 2},
    **{ILLUMINANT: 4, DATA_TYPE: 3, NUMBER_FORMAT: 0},
}
D65_10, XYZ, BINARY = 0x07, 0x05, 0x01
IDLE, WORKING, TAKEN = 2, 4, 6
MEASURE_S, RESET_S, CLEAR_S = 1.0, 0.1, 0.5
CAPACITY = 100
PLAQUE = "12345"
WHILE_BUSY = {"", "CS", "CE", "SV", "GI"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Options(CommonOptions):
    """What differs between instruments."""

    model: str = "DTP20"
    serial: str = "SIM00001"

    def __post_init__(self) -> None:
        self.check("xrite_rci", model=tuple(MODELS))


def create(panel: Panel, *, clock: Clock, seed: int = 0, **options: Any) -> XriteRci:
    """An instrument standing on ``panel``; ``options`` are the fields of `Options`."""
    return XriteRci(panel, clock, seed, Options(**options))


class XriteRci(Instrument):
    """The instrument as a state machine from bytes to bytes; see `Simulator`."""

    __slots__ = (
        "_black",
        "_busy_until",
        "_button",
        "_error",
        "_model",
        "_new",
        "_options",
        "_permanent",
        "_polled",
        "_readings",
        "_set",
        "_then_calibrated",
    )

    def __init__(self, panel: Panel, clock: Clock, seed: int, options: Options) -> None:
        super().__init__(panel, clock, seed, options)
        self._options = options
        self._model = MODELS[options.model]
        self._black = options.calibrated
        self._permanent = dict(FACTORY)
        self._set = dict(FACTORY)
        self._error = 0
        self._readings: list[FloatArray] = []
        self._new = False
        self._button = False
        self._polled = False
        self._busy_until = clock()
        self._then_calibrated = False

    @property
    def armed(self) -> bool:
        """Whether a press would be noticed: the button is on, or somebody asks `CS`."""
        return self._button or self._polled

    @property
    def awaits_plate(self) -> bool:
        """Whether it calibrates."""
        return super().awaits_plate or self._then_calibrated

    def _execute(self, command: bytes) -> bytes:
        text = command.decode("latin-1").strip().upper()
        echo = command + b"\r" if self._set[ECHO] else b""
        return echo + self._answer(text)

    def _answer(self, text: str) -> bytes:
        self._settle()
        if self._error and text != "CE":
            return self._code(self._error)
        if self._busy and text not in WHILE_BUSY:
            return self._code(BUSY)
        model = self._model
        if text in model.readout or (model.usb and re.fullmatch(r"\d{3}01GM", text)):
            return self._read_out(text)
        if text in {model.white, model.black} and text:
            return self._start_calibration(text)
        if text in model.button:
            self._button = text == model.button[0] and not model.usb
            return self._code(0)
        return self._plain(text)

    def _plain(self, text: str) -> bytes:
        match text:
            case "":
                return self._code(0)
            case "SV":
                return self._code(0, f"X-Rite {self._options.model} V1.00")
            case "GI":
                return self._code(0, *self._information())
            case "04SN":
                return self._code(0, PLAQUE)
            case "0PR" | "RI" | "5CRI":
                return self._work_for(RESET_S, lambda: self._reset(text))
            case "CE":
                self._error = 0
                return self._code(0)
            case "RM":
                return self._start_measuring()
            case "CS":
                return self._status()
            case "06BA":
                return self._code(0, "0" if self._condition == "battery_low" else "4")
            case "01XD":
                return self._code(0, str(int(self._calibrated)))
            case "00GM":
                return self._code(0, str(len(self._readings)))
            case "02CD":
                return self._clear()
            case "01ST":
                return self._code(0) if self._readings else self._fail("nothing_stored")
            case "MP":
                self._permanent = dict(self._set)
                return self._code(0)
        return self._configured(text)

    def _information(self) -> tuple[str, ...]:
        return (
            f"Serial Number: {self._options.serial}",
            "OEM Serial #: 0",
            f"Cal Plaque Serial #: {PLAQUE}",
        )

    def _configured(self, text: str) -> bytes:
        match = COMMAND.fullmatch(text)
        arguments, verb = match.groups() if match else ("", "")
        if verb == "BR" and arguments:
            return self._code(0)
        if verb != "CF":
            return self._fail("command")
        if len(arguments) != 4:
            return self._fail("parameters")
        value, switch = int(arguments[:2], 16), int(arguments[2:], 16)
        limits = {SEPARATOR: len(SEPARATORS), DELIMITER: len(DELIMITERS), DECIMALS: 6}
        if value >= limits.get(switch, 0x100):
            return self._fail("parameters")
        answer = self._code(0)
        self._set[switch] = value
        return answer

    def _reset(self, kind: str) -> bytes:
        if kind == "5CRI":
            self._permanent = dict(FACTORY)
        self._set = dict(self._permanent)
        self._error = 0
        self._polled = self._button = False
        return self._code(0)

    def _status(self) -> bytes:
        if self._busy:
            return self._code(0, str(WORKING))
        self._polled = self._model.usb and not self._new
        return self._code(0, str(TAKEN if self._new else IDLE))

    def _clear(self) -> bytes:
        self._readings.clear()
        self._new = False
        self._busy_until = self.clock() + CLEAR_S
        return self._code(0)

    def _start_calibration(self, text: str) -> bytes:
        black = text == self._model.black
        if self._model.usb:
            self._busy_until = self.clock() + self._model.calibration_s
            self._then_calibrated = True
            self._pressed_on_plate = False
            return self._code(0)
        finish = self._blackened if black else self._whitened
        return self._work_for(self._model.calibration_s, finish, on_plate=not black)

    def _blackened(self) -> bytes:
        self._black = True
        return self._code(0)

    def _whitened(self) -> bytes:
        self._calibrated = self._stands_on_plate()
        self._black = self._black or not self._model.black
        return self._code(0) if self._calibrated else self._fail("calibration")

    @property
    def _busy(self) -> bool:
        return self.clock() < self._busy_until

    def _settle(self) -> None:
        if self._then_calibrated and not self._busy:
            self._then_calibrated = False
            self._whitened()

    def _refusal(self) -> Failure | None:
        if not (self._calibrated and self._black):
            return "uncalibrated"
        return None if self._condition == "ready" else self._condition

    def _start_measuring(self) -> bytes:
        refusal = self._refusal()
        if refusal:
            return self._fail(refusal)
        return self._work_for(MEASURE_S, self._measured)

    def _measured(self) -> bytes:
        self._take()
        return self._code(0)

    def _take(self) -> None:
        kept = CAPACITY if self._model.usb else 1
        reading = 100.0 * self._look(ANGLES)[0]
        self._readings = [*self._readings, reading][-kept:]
        self._new = True
        self._polled = False

    def _on_press(self) -> bytes:
        self._settle()
        if self._busy or not (self._button or self._model.usb):
            return b""
        refusal = self._refusal()
        if refusal:
            refused = self._fail(refusal)
            return refused if self._button else b""
        self._take()
        return self._code(1) if self._button else b""

    def _read_out(self, text: str) -> bytes:
        number = int(text[:3]) if len(text) == 7 else len(self._readings)
        if not 1 <= number <= len(self._readings):
            return self._fail("nothing_stored")
        self._new = self._new and number != len(self._readings)
        percent = self._readings[number - 1]
        form = self._model.readout.get(text, "binary")
        if form == "binary" and self._set[DATA_TYPE] == XYZ:
            return self._tristimulus(percent)
        if form == "binary" and self._set[NUMBER_FORMAT] == BINARY:
            counts = np.clip(np.rint(_finite(percent) * 65535.0 / 200.0), 0, 65535)
            return counts.astype(">u2").tobytes()
        values = [f"{value:.{self._set[DECIMALS]}f}" for value in percent]
        match form:
            case "s_items":
                return self._code(0, "".join(f"S{value:>10}" for value in values))
            case "s_lines":
                lines = (f"S {value}" for value in values)
                return self._code(0, "X0.00Y0.00Z0.00", *lines)
        return self._code(0, self._separated(values))

    def _tristimulus(self, percent: FloatArray) -> bytes:
        if self._set[ILLUMINANT] != D65_10:
            return self._fail("configuration")
        if not np.isfinite(percent).all():
            return self._separated(["nan"] * 3).encode("ascii")
        lab = reflectance_to_lab(WAVELENGTHS_NM, percent / 100.0)
        xyz = lab_to_xyz(lab, white("D65", "10"))
        decimals = self._set[DECIMALS]
        return self._code(0, self._separated([f"{one:.{decimals}f}" for one in xyz]))

    def _separated(self, values: list[str]) -> str:
        return SEPARATORS[self._set[SEPARATOR]].join(values)

    def _fail(self, failure: Failure) -> bytes:
        code = self._model.codes[failure]
        if code != BUSY:
            self._error = code
        return self._code(code)

    def _code(self, code: int, *lines: str) -> bytes:
        delimiter = DELIMITERS[self._set[DELIMITER]]
        text = "".join(line + delimiter for line in lines) + f"<{code:02X}>"
        return text.encode("ascii")


def _finite(percent: FloatArray) -> FloatArray:
    """The values, the largest one that can be sent in place of none."""
    return np.nan_to_num(percent, nan=200.0)


def usb_function(simulator: Simulator) -> RciFunction:
    """The DTP20 as it appears on USB."""
    return RciFunction(simulator, serial="SIM00001")


def spectra(exchanges: Iterable[tuple[bytes, bytes]]) -> Iterator[FloatArray]:
    """Every binary spectrum that bytes hold by section 6, in factors.

    An echo of the command may stand before it.
    """
    for sent, received in exchanges:
        binary = received.removeprefix(sent)
        if sent.upper().endswith(b"01GM\r") and len(binary) == BINARY_BYTES:
            yield np.frombuffer(binary, ">u2") * 2.0 / 65535.0
