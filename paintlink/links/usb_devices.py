"""Devices on USB, found by vendor, product and serial number."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Any

import usb.core

from paintlink.errors import LinkError
from paintlink.links.advice import FAILURES
from paintlink.links.libusb_backend import libusb
from paintlink.links.usb_advice import node_of, problem_of

MAKERS = {
    0x0765: "X-Rite",
    0x0971: "GretagMacbeth",
    0x085C: "Datacolor",
}


@dataclass(frozen=True, slots=True)
class UsbInfo:
    """One USB device.

    Parameters
    ----------
    address
        What to configure as ``port``.
    usb_id
        Vendor and product, ``0765:d020``.
    problem
        What keeps us from using it and what to do; empty when nothing does.
    """

    address: str
    usb_id: str
    serial_number: str
    description: str
    node: str
    problem: str


def find_device(
    backend: object, vendor: int, product: int, serial: str, *, address: str
) -> Any:
    """Return the one device that fits; any serial number fits an empty one.

    Raises
    ------
    LinkError
        When there is none, or more than one.
    """
    try:
        fitting = [
            device
            for device in usb.core.find(
                find_all=True, backend=backend, idVendor=vendor, idProduct=product
            )
            if not serial or _serial(device) == serial
        ]
    except FAILURES as failure:
        msg = f"{address} cannot be looked for ({failure}): plug it out and in again"
        raise LinkError(msg) from failure
    if len(fitting) > 1:
        numbers = ", ".join(sorted(_serial(one) or "unknown" for one in fitting))
        msg = (
            f"{address} fits {len(fitting)} devices (serial numbers {numbers}): write "
            f"the one you mean, as in usb://{vendor:04x}:{product:04x}/SERIAL"
        )
        raise LinkError(msg)
    if not fitting:
        msg = f"{address} is not plugged in, or switched off: check the USB cable"
        raise LinkError(msg)
    return fitting[0]


def usb_devices(
    ids: Collection[str], backend: object | None = None
) -> tuple[UsbInfo, ...]:
    """Return the devices on USB whose vendor and product are among ``ids``.

    Others of makers of colour instruments are shown as well, and what to do with them.

    Raises
    ------
    LinkError
        When libusb is not installed.
    """
    found = list(usb.core.find(find_all=True, backend=backend or libusb()))
    known = [_describe(device) for device in found if _usb_id(device) in ids]
    others = [
        replace(_describe(device), address="", problem=_no_driver(device))
        for device in found
        if device.idVendor in MAKERS and _usb_id(device) not in ids
    ]
    return (*known, *others)


def _no_driver(device: Any) -> str:
    return (
        f"no driver for {_usb_id(device)} of {MAKERS[device.idVendor]}: let its own "
        "program write files and read them with `paintlink import`"
    )


def _describe(device: Any) -> UsbInfo:
    usb_id, serial = _usb_id(device), _serial(device)
    return UsbInfo(
        address=f"usb://{usb_id}/{serial}".rstrip("/"),
        usb_id=usb_id,
        serial_number=serial,
        description=_text(device, "product"),
        node=node_of(device),
        problem=problem_of(device),
    )


def _usb_id(device: Any) -> str:
    return f"{device.idVendor:04x}:{device.idProduct:04x}"


def _serial(device: Any) -> str:
    return _text(device, "serial_number")


def _text(device: Any, name: str) -> str:
    try:
        return str(getattr(device, name) or "")
    except FAILURES:
        # Reading a text opens the device, which may be forbidden.
        return ""
