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
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

from paintlink.color import lab_to_lch, reflectance_to_lab
from paintlink.model import FloatArray
from paintlink_simulators._instrument import CommonOptions, Condition, Instrument
from paintlink_simulators._simulator import Clock, Simulator
from paintlink_simulators.paint import WAVELENGTHS_NM, Panel
from paintlink_simulators.paint.panel import MAX_FACTOR
from paintlink_simulators.usb import FtdiFunction

MODELS: Mapping[str, tuple[float, ...]] = MappingProxyType({
    "MA58": (25.0, 45.0, 75.0),
    "MA68": (15.0, 25.0, 45.0, 75.0, 110.0),
    "MA68II": (15.0, 25.0, 45.0, 75.0, 110.0),
})
"""Aspecular angles by model."""

DUMP = re.compile(r"([0-9A-F]{4})([0-9A-F]{4})i")
WRITTEN = re.compile(rb"(?<![0-9A-Fa-f])([0-9A-Fa-f]{248})OK")
MEMORY_START = 0x2000
SHORTEST_DUMP = 380
WHITE = 32768
NO_NUMBER = 0x7FFFFFFF
RESET_S = 0.3
STANDARD = 0.0
REFUSALS: Mapping[Condition, str] = MappingProxyType({
    "warming": "LAMP WARMING UP",
    "battery_low": "BATTERY LOW",
    "memory_full": "MEMORY FULL",
})


@dataclass(frozen=True, slots=True, kw_only=True)
class Options(CommonOptions):
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
    heading: tuple[str, ...] = ("REFLECTANCE  STANDARD  SAMPLE",)

    def __post_init__(self) -> None:
        self.check(
            "xrite_ma",
            model=tuple(MODELS),
            grouping=(0, 8, 16),
            terminator=("\r", "\n", "\r\n"),
        )


def create(panel: Panel, *, clock: Clock, seed: int = 0, **options: Any) -> XriteMa:
    """An instrument standing on ``panel``; ``options`` are the fields of `Options`."""
    return XriteMa(panel, clock, seed, Options(**options))


class XriteMa(Instrument):
    """The instrument as a state machine from bytes to bytes; see `Simulator`."""

    __slots__ = (
        "_awaits",
        "_memory",
        "_options",
    )

    def __init__(self, panel: Panel, clock: Clock, seed: int, options: Options) -> None:
        super().__init__(panel, clock, seed, options)
        self._options = options
        self._awaits: Literal["nothing", "sample", "plate"] = "nothing"
        self._memory = b""

    @property
    def armed(self) -> bool:
        """Whether the next press answers `00A04Cw`."""
        return self._awaits == "sample"

    @property
    def awaits_plate(self) -> bool:
        """Whether the next press answers `yw`."""
        return self._awaits == "plate"

    def _on_press(self) -> bytes:
        """The report, or the outcome of the calibration, or a refusal."""
        awaited, self._awaits = self._awaits, "nothing"
        if awaited == "plate":
            self._calibrated = self.plate_on
            return self._line("OK" if self._calibrated else "CALIBRATION ERROR")
        if not self._calibrated:
            return self._line("CALIBRATION NEEDED")
        if self._condition in REFUSALS:
            return self._line(REFUSALS[self._condition])
        return self._measured()

    def _execute(self, command: bytes) -> bytes:
        text = command.decode("latin-1")
        echo = self._line(text) if self._options.echo else b""
        return echo + self._answer(text)

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
                return self._arm()
        return self._dump(command)

    def _identity(self) -> str:
        options = self._options
        return options.identity or f"X-RITE {options.model} {options.firmware}"

    def _arm(self) -> bytes:
        if self._condition in REFUSALS:
            return self._line(REFUSALS[self._condition])
        self._awaits = "sample"
        return self._line("OK")

    def _start_reset(self) -> bytes:
        self._awaits = "nothing"
        return self._work_for(RESET_S, lambda: self._line("RESET"))

    def _dump(self, command: str) -> bytes:
        match = DUMP.fullmatch(command)
        end, start = (int(digits, 16) for digits in match.groups()) if match else (0, 1)
        if end < start:
            return self._line("?")
        text = self._grouped(self._stored(start, end + 1)) + self._options.terminator
        closing = "OK" + self._options.terminator
        return (text.ljust(SHORTEST_DUMP - len(closing)) + closing).encode("ascii")

    def _stored(self, start: int, stop: int) -> bytes:
        first, last = (max(one - MEMORY_START, 0) for one in (start, stop))
        before = bytes(min(max(MEMORY_START - start, 0), stop - start))
        return (before + self._memory[first:last]).ljust(stop - start, b"\0")

    def _grouped(self, data: bytes) -> str:
        size = self._options.grouping or len(data) + 1
        groups = (data[start : start + size] for start in range(0, len(data), size))
        text = "".join(f"{group.hex(' ').upper()}  " for group in groups)
        return text if len(data) % size == 0 else text[:-1]

    def _measured(self) -> bytes:
        factors = np.nan_to_num(self._look(self._angles), nan=NO_NUMBER / WHITE)
        counts = np.rint(factors * WHITE).astype("<i4")
        self._memory = counts.tobytes()
        return self._report(counts / WHITE)

    def _report(self, factors: FloatArray) -> bytes:
        colors = _color_rows(self._angles, factors)
        rows = [*self._options.heading, *_spectral_rows(factors), *colors]
        return b"".join(map(self._line, rows))

    @property
    def _angles(self) -> tuple[float, ...]:
        return MODELS[self._options.model]

    def _line(self, text: str) -> bytes:
        return (text + self._options.terminator).encode("latin-1")


def _spectral_rows(factors: FloatArray) -> Iterator[str]:
    for wavelength, row in zip(WAVELENGTHS_NM, factors.T, strict=True):
        pairs = (f"{STANDARD:.2f} {100 * factor:.2f}" for factor in row)
        yield f"{wavelength:.0f} {' '.join(pairs)}"


def _color_rows(angles: tuple[float, ...], factors: FloatArray) -> Iterator[str]:
    labs = reflectance_to_lab(WAVELENGTHS_NM, np.clip(factors, 0.0, MAX_FACTOR))
    for angle, lab, lch in zip(
        angles, labs, np.nan_to_num(lab_to_lch(labs)), strict=True
    ):
        values = (*lab, *lch[1:])
        yield f"{angle:.0f} {' '.join(f'{value:.2f}' for value in values)}"


def usb_function(simulator: Simulator) -> FtdiFunction:
    """The instrument on a USB adapter."""
    return FtdiFunction(simulator, serial="SIM-MA")


def spectra(exchanges: Iterable[tuple[bytes, bytes]]) -> Iterator[FloatArray]:
    """Every spectrum that bytes hold by the grammar of section 4, in factors."""
    for _, received in exchanges:
        for digits in WRITTEN.findall(b"".join(received.split())):
            counts = np.frombuffer(bytes.fromhex(digits.decode("ascii")), "<i4")
            yield counts / WHITE
