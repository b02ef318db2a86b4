"""Simulated instruments, one module each; the file name is the driver id."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from paintlink_simulators import ports
from paintlink_simulators._simulator import Simulator
from paintlink_simulators._uart import LineSettings
from paintlink_simulators.faults import (
    BUNDLED,
    FAULTS,
    HARMLESS,
    STATES,
    Mutating,
    from_answer,
)
from paintlink_simulators.paint import Panel, Repeatability, SprayBooth, panel_from_lab
from paintlink_simulators.ports import (
    ManualClock,
    MemoryPort,
    Operator,
    PtyPort,
    TcpPort,
    UsbIpPort,
)
from paintlink_simulators.usb import UsbSocket

EXACT = Repeatability(gain=0.0, floor=0.0)
"""An instrument without noise."""

if TYPE_CHECKING:
    from paintlink_simulators.ports import PyusbBackend, Rfc2217Port

__all__ = [
    "BUNDLED",
    "EXACT",
    "FAULTS",
    "HARMLESS",
    "STATES",
    "LineSettings",
    "ManualClock",
    "MemoryPort",
    "Mutating",
    "Operator",
    "Panel",
    "PtyPort",
    "PyusbBackend",
    "Rfc2217Port",
    "Simulator",
    "SprayBooth",
    "TcpPort",
    "UsbIpPort",
    "UsbSocket",
    "from_answer",
    "panel_from_lab",
]


def __getattr__(name: str) -> Any:
    if name in {"PyusbBackend", "Rfc2217Port"}:
        return getattr(ports, name)
    raise AttributeError(name)
