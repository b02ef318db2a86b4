"""Places a simulated instrument can be reached at, from memory to USB/IP."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from paintlink_simulators.ports.memory import ManualClock, MemoryPort
from paintlink_simulators.ports.operator import Operator
from paintlink_simulators.ports.pty import PtyPort
from paintlink_simulators.ports.tcp import TcpPort
from paintlink_simulators.ports.usbip import UsbIpPort

if TYPE_CHECKING:
    from paintlink_simulators.ports.pyusb_backend import PyusbBackend
    from paintlink_simulators.ports.rfc2217 import Rfc2217Port

__all__ = [
    "ManualClock",
    "MemoryPort",
    "Operator",
    "PtyPort",
    "PyusbBackend",
    "Rfc2217Port",
    "TcpPort",
    "UsbIpPort",
]


_LATE = {"PyusbBackend": "pyusb_backend", "Rfc2217Port": "rfc2217"}


def __getattr__(name: str) -> Any:
    # pyusb and pyserial take long to import, and only these need them.
    if name in _LATE:
        module = importlib.import_module(f"paintlink_simulators.ports.{_LATE[name]}")
        return getattr(module, name)
    raise AttributeError(name)
