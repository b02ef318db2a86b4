"""What runs inside the lab: every list on the real kernel, against its expectation."""

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
    """The reference device behind real libusb."""

    @property
    def socket(self) -> UsbSocket:
        return self.device

    def find(self) -> Any:
        if self.device.live is None:
            return wait_for_absence()
        return wait_for(found, "the reference device")

    def press(self) -> None:
        self.device.press()


def found() -> Any:
    return usb.core.find(idVendor=0x1209, idProduct=1)


def wait_for_absence() -> None:
    wait_for(lambda: found() is None, "the end of the reference device")


def main() -> int:
    simulator = xrite_ma.create(panel(), clock=time.monotonic, seed=SEED)
    seen = observe(Kernel(UsbSocket(VendorFunction(simulator)), 0))
    differences = 0
    for check, expected in EXPECTED.items():
        got = seen.get(check, "not reached")
        mark = "" if got == expected else f"   DIFFERS, the fakes give {expected}"
        differences += got != expected
        print(f"{check:28} {got}{mark}", flush=True)
    print(f"differences between kernel and fakes: {differences}")
    return int(bool(differences))


if __name__ == "__main__":
    raise SystemExit(main())
