"""A simulated X-Rite MA58, MA68 or MA68II, written from docs/wire/xrite_ma.md.

Modelled: the commands of section 3 and ``?`` for all others, memory dumps of any range
(section 4), the printed report (5), white calibration, arming and pressing (6). Open
points of the page are decided so: every press of a calibrated instrument measures and
prints, armed or not; a press ends whatever was awaited, also when it is refused; while
a reset runs, presses are ignored and commands wait; an MA58 prints its three angles;
no standard is stored, so the report prints 0.00 for it; report colours are D65/10.

Deliberately not modelled: baud rate and modem lines, keyboard and display, writing to
other addresses, stored standards, drift and expiry of the calibration, readings of the
plaque. Never met real hardware.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

from paintlink.color import lab_to_lch, reflectance_to_lab
from paintlink.errors import ConfigError
from paintlink_simulators._simulator import Clock
from paintlink_simulators.paint import TYPICAL, Panel, Repeatability, noisy

MODELS: Mapping[str, tuple[float, ...]] = MappingProxyType({
    "MA58": (25.0, 45.0, 75.0),
    "MA68": (15.0, 25.0, 45.0, 75.0, 110.0),
    "MA68II": (15.0, 25.0, 45.0, 75.0, 110.0),
})
"""Aspecular angles by model."""

HOST_LINE_END = b"\r"
DUMP = re.compile(r"([0-9A-F]{4})([0-9A-F]{4})i")
MEMORY_START = 0x2000
SHORTEST_DUMP = 380
WHITE = 32768
RESET_S = 0.3
STANDARD = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """What differs between instruments, or is not known of the real one.

    Parameters
    ----------
    identity
        What it answers to ``v``, instead of its model and firmware.
    grouping
        A dump has one more blank after so many bytes; 0 for none.
    terminator
        End of every line it sends.
    echo
        Whether it repeats each command as a line before the answer.
    heading
        Lines above the report.
    """

    model: str = "MA68II"
    firmware: str = "3.02"
    identity: str | None = None
    grouping: Literal[0, 8, 16] = 0
    terminator: Literal["\r", "\n", "\r\n"] = "\r\n"
    echo: bool = False
    calibrated: bool = True
    plate_on: bool = False
    heading: tuple[str, ...] = ("REFLECTANCE  STANDARD  SAMPLE",)
    repeatability: Repeatability = TYPICAL

    def __post_init__(self) -> None:
        self._check("model", tuple(MODELS))
        self._check("grouping", (0, 8, 16))
        self._check("terminator", ("\r", "\n", "\r\n"))

    def _check(self, option: str, choices: tuple[object, ...]) -> None:
        value = getattr(self, option)
        if value not in choices:
            known = ", ".join(map(repr, choices))
            msg = f"simulator xrite_ma: {option} = {value!r} is not one of {known}"
            raise ConfigError(msg)


def create(panel: Panel, *, clock: Clock, seed: int = 0, **options: Any) -> XriteMa:
    """An instrument standing on ``panel``; ``options`` are the fields of `Options`."""
    return XriteMa(panel, clock, seed, Options(**options))


class XriteMa:
    """The instrument as a state machine from bytes to bytes; see `Simulator`."""

    __slots__ = (
        "_awaits",
        "_calibrated",
        "_memory",
        "_options",
        "_received",
        "_reset_at",
        "_rng",
        "clock",
        "panel",
        "plate_on",
    )

    def __init__(self, panel: Panel, clock: Clock, seed: int, options: Options) -> None:
        self.panel = panel
        self.clock = clock
        self.plate_on = options.plate_on
        self._options = options
        self._rng = np.random.default_rng(seed)
        self._calibrated = options.calibrated
        self._awaits: Literal["nothing", "sample", "plate"] = "nothing"
        self._memory = b""
        self._received = b""
        self._reset_at: float | None = None

    @property
    def armed(self) -> bool:
        """Whether the next press answers `00A04Cw`."""
        return self._awaits == "sample"

    @property
    def awaits_plate(self) -> bool:
        """Whether the next press answers `yw`."""
        return self._awaits == "plate"

    def feed(self, data: bytes) -> bytes:
        """The answers to the commands that ``data`` completes."""
        self._received += data
        return self.poll()

    def poll(self) -> bytes:
        """RESET when its time has come, and the answers to commands held up by it."""
        sent = self._finished_reset()
        while self._reset_at is None and HOST_LINE_END in self._received:
            command, _, self._received = self._received.partition(HOST_LINE_END)
            sent += self._execute(command.decode("latin-1"))
        return sent

    def due_at(self) -> float | None:
        """When a running reset ends."""
        return self._reset_at

    def disconnect(self) -> None:
        """Forget the unfinished command and a RESET still owed."""
        self._received = b""
        self._reset_at = None

    def press(self) -> bytes:
        """The report, or the outcome of the calibration, or a refusal."""
        if self._reset_at is not None:
            return b""
        awaited, self._awaits = self._awaits, "nothing"
        if awaited == "plate":
            self._calibrated = self.plate_on
            return self._line("OK" if self._calibrated else "CALIBRATION ERROR")
        if not self._calibrated:
            return self._line("CALIBRATION NEEDED")
        return self._measured()

    def _execute(self, command: str) -> bytes:
        echo = self._line(command) if self._options.echo else b""
        return echo + self._answer(command)

    def _answer(self, command: str) -> bytes:
        match command:
            case "v":
                return self._line(self._identity())
            case "p":
                return self._start_reset()
            case "3ys":
                self._calibrated = False
                return self._line("CALIBRATION NEEDED")
            case "ys":
                state = "OK" if self._calibrated else "NEEDED"
                return self._line(f"CALIBRATION {state}")
            case "yw":
                self._awaits = "plate"
                return b""
            case "00A04Cw":
                self._awaits = "sample"
                return self._line("OK")
        return self._dump(command)

    def _identity(self) -> str:
        options = self._options
        return options.identity or f"X-RITE {options.model} {options.firmware}"

    def _start_reset(self) -> bytes:
        self._awaits = "nothing"
        self._reset_at = self.clock() + RESET_S
        return b""

    def _finished_reset(self) -> bytes:
        if self._reset_at is None or self.clock() < self._reset_at:
            return b""
        self._reset_at = None
        return self._line("RESET")

    def _dump(self, command: str) -> bytes:
        match = DUMP.fullmatch(command)
        end, start = (int(digits, 16) for digits in match.groups()) if match else (0, 1)
        if end < start:
            return self._line("?")
        text = self._grouped(self._stored(start, end + 1)) + self._options.terminator
        closing = "OK" + self._options.terminator
        return (text.ljust(SHORTEST_DUMP - len(closing)) + closing).encode("ascii")

    def _stored(self, start: int, stop: int) -> bytes:
        return bytes(
            self._memory[address - MEMORY_START]
            if MEMORY_START <= address < MEMORY_START + len(self._memory)
            else 0
            for address in range(start, stop)
        )

    def _grouped(self, data: bytes) -> str:
        size = self._options.grouping or len(data) + 1
        return "".join(
            f"{byte:02X} " + " " * (count % size == 0)
            for count, byte in enumerate(data, start=1)
        )

    def _measured(self) -> bytes:
        angles = np.array(MODELS[self._options.model])
        seen = replace(
            self.panel, aspecular_deg=angles, factors=self.panel.factors_at(angles)
        )
        reading = noisy(seen, self._rng, self._options.repeatability)
        counts = np.rint(reading.factors * WHITE).astype("<i4")
        self._memory = counts.tobytes()
        return self._report(replace(seen, factors=counts / WHITE))

    def _report(self, reading: Panel) -> bytes:
        rows = [*self._options.heading, *_spectral_rows(reading), *_color_rows(reading)]
        return b"".join(map(self._line, rows))

    def _line(self, text: str) -> bytes:
        return (text + self._options.terminator).encode("latin-1")


def _spectral_rows(reading: Panel) -> Iterator[str]:
    for wavelength, factors in zip(
        reading.wavelengths_nm, reading.factors.T, strict=True
    ):
        pairs = (f"{STANDARD:.2f} {100 * factor:.2f}" for factor in factors)
        yield f"{wavelength:.0f} {' '.join(pairs)}"


def _color_rows(reading: Panel) -> Iterator[str]:
    labs = reflectance_to_lab(reading.wavelengths_nm, reading.factors)
    for angle, lab, lch in zip(
        reading.aspecular_deg, labs, np.nan_to_num(lab_to_lch(labs)), strict=True
    ):
        values = (*lab, *lch[1:])
        yield f"{angle:.0f} {' '.join(f'{value:.2f}' for value in values)}"
