"""Places a simulated instrument can be reached at: memory, pty, TCP, USB/IP, pyusb."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from paintlink_simulators.ports.memory import ManualClock, MemoryPort
from paintlink_simulators.ports.operator import Operator
from paintlink_simulators.ports.pty import PtyPort
from paintlink_simulators.ports.tcp import TcpPort
from paintlink_simulators.ports.usbip import UsbIpPort

if TYPE_CHECKING:
    from paintlink_simulators.ports.pyusb_backend import PyusbBackend

__all__ = [
    "ManualClock",
    "MemoryPort",
    "Operator",
    "PtyPort",
    "PyusbBackend",
    "TcpPort",
    "UsbIpPort",
]


def __getattr__(name: str) -> Any:
    # pyusb takes long to import, and only this one needs it.
    if name == "PyusbBackend":
        from paintlink_simulators.ports.pyusb_backend import PyusbBackend

        return PyusbBackend
    raise AttributeError(name)
