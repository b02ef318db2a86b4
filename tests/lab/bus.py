"""The reference device behind real libusb, against the list of the fakes."""

from __future__ import annotations

import time
from typing import Any

import usb.core

from paintlink_simulators import xrite_ma
from paintlink_simulators.usb import UsbSocket, VendorFunction
from tests.conformance.bench import SEED, panel
from tests.conformance.usb_list import EXPECTED, observe
from tests.lab.vhci import Plug, wait_for


class Kernel(Plug):
    """A device in the kernel's controller, as a user of libusb sees it."""

    @property
    def socket(self) -> UsbSocket:
        return self.device

    def find(self) -> Any:
        if self.device.live is None:
            wait_for(lambda: _found() is None, "the end of the reference device")
            return None
        return wait_for(_found, "the reference device")


def compare_usb() -> list[str]:
    """A line for each check in which libusb differs from the fakes; prints all."""
    simulator = xrite_ma.create(panel(), clock=time.monotonic, seed=SEED)
    bus = Kernel(UsbSocket(VendorFunction(simulator)), 0)
    seen = observe(bus)
    bus.forget()
    lines = []
    for check, expected in EXPECTED.items():
        got = seen.get(check, "not reached")
        print(f"{check:28} {got}", flush=True)
        if got != expected:
            lines.append(f"{check}: {got}, the fakes give {expected}")
    return lines


def _found() -> Any:
    return usb.core.find(idVendor=0x1209, idProduct=1)
