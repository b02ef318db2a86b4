"""Control requests, and the descriptors every device answers them with."""

from __future__ import annotations

import struct
from typing import NamedTuple

GET_STATUS, CLEAR_FEATURE, SET_FEATURE, SET_ADDRESS = 0, 1, 3, 5
GET_DESCRIPTOR, GET_CONFIGURATION, SET_CONFIGURATION = 6, 8, 9
GET_INTERFACE, SET_INTERFACE = 10, 11
DEVICE, CONFIGURATION, STRING, INTERFACE, ENDPOINT = 1, 2, 3, 4, 5
IN = 0x80
STANDARD = 0x60  # bits of the request type that are 0 in a standard request
ENGLISH = 0x0409


class StallError(Exception):
    """The device refuses the request, or has halted the endpoint."""


class Setup(NamedTuple):
    """The eight bytes that begin a control request."""

    kind: int
    request: int
    value: int
    target: int
    length: int

    @classmethod
    def parse(cls, data: bytes) -> Setup:
        """The request in eight bytes."""
        return cls(*struct.unpack("<BBHHH", data))

    def pack(self) -> bytes:
        """The eight bytes."""
        return struct.pack("<BBHHH", *self)

    @property
    def standard(self) -> bool:
        """Whether it is for every device, not for a class or vendor."""
        return not self.kind & STANDARD


class Endpoint(NamedTuple):
    """One endpoint descriptor."""

    address: int
    attributes: int
    packet_size: int
    interval: int
    raw: bytes


def split(configuration: bytes) -> list[bytes]:
    """The single descriptors of a configuration."""
    parts = []
    while configuration:
        size = configuration[0]
        parts.append(configuration[:size])
        configuration = configuration[size:]
    return parts


def endpoint(descriptor: bytes) -> Endpoint:
    """The endpoint a descriptor is about."""
    _, _, address, attributes, size, interval = struct.unpack("<BBBBHB", descriptor)
    return Endpoint(address, attributes, size, interval, descriptor)


def endpoints(configuration: bytes) -> dict[int, Endpoint]:
    """Every endpoint of a configuration by its address."""
    found = [endpoint(one) for one in split(configuration) if one[1] == ENDPOINT]
    return {one.address: one for one in found}


def string_descriptor(strings: tuple[str, ...], index: int) -> bytes:
    """The languages for index 0, else the text with this 1-based index."""
    if index == 0:
        return struct.pack("<BBH", 4, STRING, ENGLISH)
    if index > len(strings):
        raise StallError
    text = strings[index - 1].encode("utf-16-le")
    return bytes((len(text) + 2, STRING)) + text
