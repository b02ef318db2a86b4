"""Addresses of instruments, and what they say."""

from __future__ import annotations

import re
from typing import Literal

from paintlink.errors import LinkError
from paintlink.instrument import quoted
from paintlink.links.advice import FORMS

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


def _refused(address: str, form: str) -> LinkError:
    msg = f"{quoted(address)} is no address of a port such as {form}: {FORMS}"
    return LinkError(msg)
