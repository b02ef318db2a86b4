"""USB/IP messages, version 1.1.1; the kernel's Documentation/usb/usbip_protocol.rst."""

from __future__ import annotations

import struct
from typing import NamedTuple

VERSION = 0x0111
LIST, LIST_REPLY = 0x8005, 0x0005
IMPORT, IMPORT_REPLY = 0x8003, 0x0003
SUBMIT, UNLINK, RET_SUBMIT, RET_UNLINK = 1, 2, 3, 4
OPERATION = struct.Struct(">HHI")
URB = struct.Struct(">5I28s")
_DEVICE = struct.Struct(">256s32sIIIHHHBBBBBB")
_SUBMIT = struct.Struct(">IiiiI8s")
_RESULT = struct.Struct(">5i8x")
DEVICE_SIZE, URB_SIZE, OPERATION_SIZE = _DEVICE.size, URB.size, OPERATION.size
NOT_ISOCHRONOUS = -1


class Exported(NamedTuple):
    """A device that a USB/IP server offers."""

    busid: str
    busnum: int
    devnum: int
    speed: int
    vendor_id: int
    product_id: int
    interfaces: int

    @property
    def devid(self) -> int:
        """The number its messages carry."""
        return self.busnum << 16 | self.devnum


class Returned(NamedTuple):
    """The head of an answer: data follow where a submitted transfer was inward."""

    command: int
    sequence: int
    status: int
    length: int


def list_request() -> bytes:
    """Return the question for everything exported."""
    return OPERATION.pack(VERSION, LIST, 0)


def import_request(busid: str) -> bytes:
    """Return the request for one device."""
    return OPERATION.pack(VERSION, IMPORT, 0) + busid.encode("ascii").ljust(32, b"\0")


def parse_device(block: bytes) -> Exported:
    """Return the device of a block of 312 bytes."""
    _, name, *fields = _DEVICE.unpack(block)
    busnum, devnum, speed, vendor, product = fields[:5]
    return Exported(
        busid=name.split(b"\0", 1)[0].decode("ascii", "replace"),
        busnum=busnum,
        devnum=devnum,
        speed=speed,
        vendor_id=vendor,
        product_id=product,
        interfaces=fields[-1],
    )


def submit(
    sequence: int,
    devid: int,
    endpoint: int,
    *,
    length: int,
    setup: bytes = bytes(8),
    data: bytes = b"",
) -> bytes:
    """Return a transfer; bit 7 of ``endpoint`` set means towards us."""
    inward = endpoint >> 7
    body = _SUBMIT.pack(0, length, 0, NOT_ISOCHRONOUS, 0, setup)
    head = URB.pack(SUBMIT, sequence, devid, inward, endpoint & 0x7F, body)
    return head + (b"" if inward else data)


def unlink(sequence: int, devid: int, victim: int) -> bytes:
    """Return the request to give up the transfer ``victim``."""
    body = struct.pack(">I24x", victim)
    return URB.pack(UNLINK, sequence, devid, 0, 0, body)


def parse_return(head: bytes) -> Returned:
    """Return the head of an answer, 48 bytes."""
    command, sequence, _, _, _, body = URB.unpack(head)
    status, length, *_ = _RESULT.unpack(body)
    return Returned(command, sequence, status, length)
