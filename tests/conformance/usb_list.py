"""What a host sees of one USB device: the same list for fakes and for the kernel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Protocol

import usb.core
import usb.util

from paintlink_simulators.usb import UsbSocket

OUT, IN, BUTTON = 0x01, 0x81, 0x82
STATUS = (0xC0, 0x10)
IDENTITY = "X-RITE MA68II 3.02\r\n"
SOON_S = 0.1
LATER_MS = 5000

EXPECTED = {
    "strings": "SIM0001, MA5, paintlink sims, 0x100",
    "kernel driver": "False",
    "endpoints": "(1, 2, 64) (129, 2, 64) (130, 3, 8)",
    "write": "2",
    "read": repr(IDENTITY.encode()),
    "read with nothing pending": "USBTimeoutError 110",
    "status": "0500010001000000",
    "status, 64 bytes wanted": "8",
    "unknown request": "USBError 32",
    "good request after it": "8",
    "button": "0100",
    "halted": "USBError 32",
    "still halted": "USBError 32",
    "after clearing": "USBTimeoutError 110",
    "buffer of 8 bytes": "USBError 75",
    "packet is lost": "USBTimeoutError 110",
    "answer of 64 bytes": "64",
    "reset": "None",
    "unplugged while reading": "USBError 19",
    "write when unplugged": "USBError 19",
    "control when unplugged": "USBError 19",
    "find when unplugged": "None",
    "dispose when unplugged": "None",
    "found again": "SIM0001",
    "read again": repr(IDENTITY.encode()),
}
"""The result of each check, in the order they are made."""


class Bus(Protocol):
    """A way to the device: what differs between the fakes and the kernel."""

    socket: UsbSocket

    def find(self) -> Any:
        """The device of pyusb, or None."""
        ...

    def unplug(self) -> None:
        """Pull the device."""

    def replug(self) -> None:
        """Put it back, and wait until a host can see it."""


def observe(bus: Bus) -> dict[str, str]:
    """The result of every check of `EXPECTED`."""
    seen: dict[str, str] = {}
    device = bus.find()
    device.set_configuration()
    _look(seen, device)
    _talk(seen, device)
    _control(seen, device)
    seen["button"] = _during(
        bus.socket.press, lambda: bytes(device.read(BUTTON, 8, LATER_MS)).hex()
    )
    _drain(device)
    _halt(seen, device, bus)
    _overflow(seen, device)
    seen["reset"] = _outcome(device.reset)
    _unplug(seen, device, bus)
    _replug(seen, bus)
    return seen


def _look(seen: dict[str, str], device: Any) -> None:
    seen["strings"] = _outcome(
        lambda: (
            f"{device.serial_number}, {device.product}, {device.manufacturer}, "
            f"{device.bcdDevice:#x}"
        )
    )
    seen["kernel driver"] = _outcome(lambda: device.is_kernel_driver_active(0))
    interface = device.get_active_configuration()[(0, 0)]
    seen["endpoints"] = " ".join(
        str((one.bEndpointAddress, one.bmAttributes, one.wMaxPacketSize))
        for one in interface
    )


def _talk(seen: dict[str, str], device: Any) -> None:
    seen["write"] = _outcome(lambda: device.write(OUT, b"v\r", 1000))
    seen["read"] = _read(device, 512)
    seen["read with nothing pending"] = _read(device, 512, 100)


def _control(seen: dict[str, str], device: Any) -> None:
    def status(length: int) -> bytes:
        return bytes(device.ctrl_transfer(*STATUS, 0, 0, length, 1000))

    seen["status"] = _outcome(lambda: status(8).hex())
    seen["status, 64 bytes wanted"] = _outcome(lambda: len(status(64)))
    seen["unknown request"] = _outcome(
        lambda: device.ctrl_transfer(0xC0, 0x77, 0, 0, 8, 1000)
    )
    seen["good request after it"] = _outcome(lambda: len(status(8)))


def _halt(seen: dict[str, str], device: Any, bus: Bus) -> None:
    engine = bus.socket.engine
    assert engine is not None
    engine.halt(IN)
    seen["halted"] = _read(device, 512)
    seen["still halted"] = _read(device, 512)
    device.clear_halt(IN)
    seen["after clearing"] = _read(device, 512, 100)


def _overflow(seen: dict[str, str], device: Any) -> None:
    device.write(OUT, b"v\r", 1000)
    seen["buffer of 8 bytes"] = _read(device, 8)
    seen["packet is lost"] = _read(device, 512, 100)
    # "?" CR LF twenty times, and OK CR LF
    device.write(OUT, b"x\r" * 20 + b"00A04Cw\r", 1000)
    seen["answer of 64 bytes"] = _outcome(lambda: len(_raw_read(device, 512, 1000)))


def _unplug(seen: dict[str, str], device: Any, bus: Bus) -> None:
    seen["unplugged while reading"] = _during(
        bus.unplug, lambda: _raw_read(device, 512, LATER_MS)
    )
    seen["write when unplugged"] = _outcome(lambda: device.write(OUT, b"v\r", 1000))
    seen["control when unplugged"] = _outcome(
        lambda: device.ctrl_transfer(*STATUS, 0, 0, 8, 1000)
    )
    seen["find when unplugged"] = _outcome(bus.find)
    seen["dispose when unplugged"] = _outcome(
        lambda: usb.util.dispose_resources(device)
    )


def _replug(seen: dict[str, str], bus: Bus) -> None:
    bus.replug()
    device = bus.find()
    seen["found again"] = _outcome(lambda: device.serial_number)
    device.set_configuration()
    device.write(OUT, b"v\r", 1000)
    seen["read again"] = _read(device, 512)
    usb.util.dispose_resources(device)


def _raw_read(device: Any, size: int, timeout_ms: int) -> bytes:
    return bytes(device.read(IN, size, timeout_ms))


def _read(device: Any, size: int, timeout_ms: int = 1000) -> str:
    return _outcome(lambda: _raw_read(device, size, timeout_ms))


def _drain(device: Any) -> None:
    """Drop the report that the press has printed."""
    while not _read(device, 4096, 200).startswith("USB"):
        pass


def _during(event: Callable[[], None], wait: Callable[[], object]) -> str:
    timer = threading.Timer(SOON_S, event)
    timer.start()
    try:
        return _outcome(wait)
    finally:
        timer.join()


def _outcome(call: Callable[[], object]) -> str:
    """What it returned, or the class and errno of what it raised."""
    try:
        return str(call())
    except usb.core.USBError as error:
        return f"{type(error).__name__} {error.errno}"
