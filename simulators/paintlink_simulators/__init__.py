"""Simulated instruments, one module each; the file name is the driver id."""

from paintlink_simulators._simulator import Simulator
from paintlink_simulators.faults import FAULTS
from paintlink_simulators.paint import Panel, panel_from_lab
from paintlink_simulators.ports import (
    ManualClock,
    MemoryPort,
    Operator,
    PtyPort,
    TcpPort,
)

__all__ = [
    "FAULTS",
    "ManualClock",
    "MemoryPort",
    "Operator",
    "Panel",
    "PtyPort",
    "Simulator",
    "TcpPort",
    "panel_from_lab",
]
