"""Addresses of instruments, and one way to open all of them."""

from __future__ import annotations

import re
from typing import Literal

from paintlink.errors import LinkError
from paintlink.instrument import ByteStream, SerialSettings, UsbSettings, quoted
from paintlink.links.advice import FORMS
from paintlink.links.stream import open_serial

Kind = Literal["device", "network", "usb", "usbip"]

_USB = re.compile(r"usb://([0-9a-fA-F]{4}):([0-9a-fA-F]{4})(?:/(.*))?")
_USBIP = re.compile(
    r"usb\+ip://([^/?:]+|\[[0-9a-fA-F:]+\])(?::(\d{1,5}))?/([\w.-]{1,31})"
)
USBIP_PORT = 3240


def kind_of(address: str) -> Kind:
    """Return what kind of address this is; it is not checked further."""
    if address.startswith("usb://"):
        return "usb"
    if address.startswith("usb+ip://"):
        return "usbip"
    return "network" if "://" in address else "device"


def parse_usb(address: str) -> tuple[int, int, str]:
    """Return vendor, product and serial number of ``usb://VID:PID/SERIAL``.

    The serial number is empty where none is given: any one will do.

    Raises
    ------
    LinkError
        When the address is not of this form.
    """
    match = _USB.fullmatch(address)
    if match is None:
        raise _refused(address, "usb://0765:d020/SERIAL")
    return int(match[1], 16), int(match[2], 16), match[3] or ""


def parse_usbip(address: str) -> tuple[str, int, str]:
    """Return host, port and bus id of ``usb+ip://host:port/busid``.

    Raises
    ------
    LinkError
        When the address is not of this form.
    """
    match = _USBIP.fullmatch(address)
    if match is None:
        raise _refused(address, "usb+ip://host:3240/1-1")
    return match[1].strip("[]"), int(match[2] or USBIP_PORT), match[3]


def open_link(
    address: str, serial: SerialSettings, usb: UsbSettings | None = None
) -> ByteStream:
    """Return an open connection with nothing left in its input.

    Parameters
    ----------
    address
        A device path, ``socket://host:port``, ``rfc2217://host:port``,
        ``usb://VID:PID/SERIAL`` or ``usb+ip://host:port/busid``.
    serial
        How a serial line is set.
    usb
        How the instrument is reached on USB; None when it has a serial line only.

    Raises
    ------
    LinkError
        With the next step for the operator.
    """
    kind = kind_of(address)
    if kind in {"device", "network"}:
        return open_serial(address, serial)
    if usb is None:
        msg = (
            f"{address}: this instrument has a serial line, not a USB protocol of its "
            "own: give the serial port it appears as, such as /dev/ttyUSB0"
        )
        raise LinkError(msg)
    # pyusb is wanted by few and loads a library of the system.
    from paintlink.links.usb_stream import open_usb
    from paintlink.links.usbip_backend import open_usbip

    return (open_usb if kind == "usb" else open_usbip)(address, usb)


def _refused(address: str, form: str) -> LinkError:
    msg = f"{quoted(address)} is no address of a port such as {form}: {FORMS}"
    return LinkError(msg)
