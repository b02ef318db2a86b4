"""USB descriptors as pyusb wants them, from the bytes a device sends."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from types import SimpleNamespace

_DEVICE_FIELDS = [
    "bLength",
    "bDescriptorType",
    "bcdUSB",
    "bDeviceClass",
    "bDeviceSubClass",
    "bDeviceProtocol",
    "bMaxPacketSize0",
    "idVendor",
    "idProduct",
    "bcdDevice",
    "iManufacturer",
    "iProduct",
    "iSerialNumber",
    "bNumConfigurations",
]
_CONFIGURATION_FIELDS = [
    "bLength",
    "bDescriptorType",
    "wTotalLength",
    "bNumInterfaces",
    "bConfigurationValue",
    "iConfiguration",
    "bmAttributes",
    "bMaxPower",
]
_INTERFACE_FIELDS = [
    "bLength",
    "bDescriptorType",
    "bInterfaceNumber",
    "bAlternateSetting",
    "bNumEndpoints",
    "bInterfaceClass",
    "bInterfaceSubClass",
    "bInterfaceProtocol",
    "iInterface",
]
_ENDPOINT_FIELDS = [
    "bLength",
    "bDescriptorType",
    "bEndpointAddress",
    "bmAttributes",
    "wMaxPacketSize",
    "bInterval",
]
_DEVICE = struct.Struct("<BBHBBBBHHHBBBB")
_CONFIGURATION = struct.Struct("<BBHBBBBB")
_INTERFACE = struct.Struct("<9B")
_ENDPOINT = struct.Struct("<BBBBHB")
DEVICE_SIZE, CONFIGURATION_SIZE = _DEVICE.size, _CONFIGURATION.size
INTERFACE_TYPE, ENDPOINT_TYPE = 4, 5


@dataclass(frozen=True)
class Interface:
    """One setting of an interface."""

    descriptor: SimpleNamespace
    endpoints: list[SimpleNamespace] = field(default_factory=list)


@dataclass(frozen=True)
class Configuration:
    """A configuration with its interfaces."""

    descriptor: SimpleNamespace
    interfaces: list[Interface]

    def setting(self, interface: int, alternate: int) -> Interface:
        """Return one setting; the first argument counts interfaces from 0.

        Raises
        ------
        IndexError
            Past the end, as pyusb expects.
        """
        numbers = sorted({one.descriptor.bInterfaceNumber for one in self.interfaces})
        settings = [
            one
            for one in self.interfaces
            if one.descriptor.bInterfaceNumber == numbers[interface]
        ]
        return settings[alternate]


def device_descriptor(data: bytes, **place: object) -> SimpleNamespace:
    """Return the device of 18 bytes; ``place`` adds bus, address and so on."""
    fields = dict(zip(_DEVICE_FIELDS, _DEVICE.unpack(data[:DEVICE_SIZE]), strict=True))
    return SimpleNamespace(**fields, **place)


def parse_configuration(data: bytes) -> Configuration:
    """Return the configuration of its full descriptor.

    Raises
    ------
    ValueError
        When a descriptor is shorter than it has to be.
    """
    values = _CONFIGURATION.unpack(data[:CONFIGURATION_SIZE])
    head = SimpleNamespace(
        **dict(zip(_CONFIGURATION_FIELDS, values, strict=True)), extra_descriptors=[]
    )
    interfaces: list[Interface] = []
    at = data[0]
    while at + 2 <= len(data):
        piece = data[at : at + max(2, data[at])]
        _add(interfaces, piece)
        at += len(piece)
    return Configuration(head, interfaces)


def _add(interfaces: list[Interface], piece: bytes) -> None:
    kind = piece[1]
    if kind == INTERFACE_TYPE:
        interfaces.append(Interface(_part(_INTERFACE, _INTERFACE_FIELDS, piece)))
    elif kind == ENDPOINT_TYPE and interfaces:
        endpoint = _part(_ENDPOINT, _ENDPOINT_FIELDS, piece)
        endpoint.bRefresh = endpoint.bSynchAddress = 0
        interfaces[-1].endpoints.append(endpoint)


def _part(layout: struct.Struct, names: list[str], piece: bytes) -> SimpleNamespace:
    try:
        values = layout.unpack(piece[: layout.size])
    except struct.error as error:
        msg = f"a USB descriptor is cut short: {piece.hex()}"
        raise ValueError(msg) from error
    return SimpleNamespace(
        **dict(zip(names, values, strict=True)), extra_descriptors=[]
    )
