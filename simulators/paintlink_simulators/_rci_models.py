"""What differs between the models that speak the RCI dialect; see xrite_rci.md."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

Failure = Literal[
    "command", "parameters", "uncalibrated", "calibration", "warming", "battery_low",
    "memory_full", "nothing_stored", "configuration",
]  # fmt: skip

GENERATION_1: Mapping[Failure, int] = MappingProxyType({
    "command": 0x01,
    "parameters": 0x02,
    "uncalibrated": 0x12,
    "calibration": 0x13,
    "warming": 0x10,
    "battery_low": 0x23,
    "memory_full": 0x04,
    "nothing_stored": 0x09,
    "configuration": 0x02,
})
GENERATION_2: Mapping[Failure, int] = MappingProxyType({
    "command": 0x11,
    "parameters": 0x12,
    "uncalibrated": 0x28,
    "calibration": 0x29,
    "warming": 0x14,
    "battery_low": 0x3B,
    "memory_full": 0x37,
    "nothing_stored": 0x42,
    "configuration": 0x3F,
})
BUSY = 0x14


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """One model: what it calls things, and how it shows a reading.

    Parameters
    ----------
    white, black
        Commands of the calibrations; no black one where it is empty.
    readout
        Command of the spectrum to how it is written.
    button
        Commands that switch the button on and off.
    """

    generation: Literal[1, 2] = 2
    white: str
    black: str = ""
    calibration_s: float = 3.0
    readout: Mapping[str, Literal["line", "binary", "s_items", "s_lines"]]
    button: tuple[str, str] = ("01PB", "00PB")
    usb: bool = False

    @property
    def codes(self) -> Mapping[Failure, int]:
        """The code of each failure."""
        return GENERATION_1 if self.generation == 1 else GENERATION_2


MODELS: Mapping[str, Model] = MappingProxyType({
    "DTP20": Model(white="CR", readout={"01GM": "binary"}, usb=True),
    "530": Model(white="UC", readout={"03TS": "line"}),
    "SP62": Model(white="10XD", readout={"001GM": "line", "101GM": "line"}),
    "CA22": Model(
        white="CA", black="CB", calibration_s=2.0, readout={"1SR": "s_items"}
    ),
    "DTP22": Model(
        generation=1,
        white="1CA",
        readout={"0SR": "s_lines"},
        button=("3PB", "2PB"),
    ),
})
