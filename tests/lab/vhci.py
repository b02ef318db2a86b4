"""Simulated USB devices plugged into the kernel of this machine, by vhci-hcd."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from paintlink_simulators.ports.usbip import FULL_SPEED, serve
from paintlink_simulators.usb import UsbSocket

CONTROLLER = Path("/sys/devices/platform/vhci_hcd.0")
PATIENCE_S = 60.0
T = TypeVar("T")


class Plug:
    """A simulated device in one port of the kernel's virtual controller."""

    def __init__(self, device: UsbSocket, port: int) -> None:
        self.device = device
        self._port = port
        self._attach()

    @property
    def place(self) -> Path:
        """Where the kernel shows the device while it knows it."""
        return CONTROLLER / "usb1" / f"1-{self._port + 1}"

    def unplug(self) -> None:
        """Pull it out."""
        self.device.unplug()

    def forget(self) -> None:
        """Pull it out, and return when the kernel has forgotten it."""
        self.unplug()
        wait_for(self._forgotten, f"the end of the device in port {self._port}")

    def replug(self) -> None:
        """Put it back."""
        self.forget()
        self.device.replug()
        self._attach()

    def _attach(self) -> None:
        engine = self.device.engine
        assert engine is not None
        kernel, ours = socket.socketpair()
        number = 0x10000 | self.device.address
        with kernel:
            (CONTROLLER / "attach").write_text(
                f"{self._port} {kernel.fileno()} {number} {FULL_SPEED}"
            )
        threading.Thread(target=serve, args=(ours, engine), daemon=True).start()

    def _forgotten(self) -> bool:
        return not self.place.exists() and self._port_free()

    def _port_free(self) -> bool:
        rows = (CONTROLLER / "status").read_text().splitlines()[1:]
        return any(
            int(row.split()[1]) == self._port and int(row.split()[2]) == 4
            for row in rows
        )


def serial_node(place: Path) -> Path | None:
    """The serial port of the device at ``place``, once it can be opened."""
    for pattern in ("1-*:*/ttyUSB*", "1-*:*/tty/ttyACM*"):
        for found in place.glob(pattern):
            node = Path("/dev", found.name)
            if node.exists():
                return node
    return None


def wait_for(ready: Callable[[], T | None], what: str) -> T:
    """What ``ready`` returns as soon as that is true.

    Raises
    ------
    TimeoutError
        When it does not become true.
    """
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        found = ready()
        if found:
            return found
        time.sleep(0.02)
    msg = f"{what} did not appear within {PATIENCE_S:g} s"
    raise TimeoutError(msg)
