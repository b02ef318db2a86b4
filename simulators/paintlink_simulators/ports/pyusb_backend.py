"""Simulated USB devices for pyusb in the same process: ``find(backend=...)``."""

from __future__ import annotations

import errno
import os
import threading
from collections.abc import Iterator, Sequence
from types import SimpleNamespace
from typing import Any

import usb.backend
import usb.core

from paintlink_simulators.usb import _requests
from paintlink_simulators.usb._requests import ENDPOINT, IN, INTERFACE, Setup, split
from paintlink_simulators.usb.engine import Engine, Urb
from paintlink_simulators.usb.socket import UsbSocket

DEVICE_FIELDS = (
    "bLength bDescriptorType bcdUSB bDeviceClass bDeviceSubClass bDeviceProtocol "
    "bMaxPacketSize0 idVendor idProduct bcdDevice iManufacturer iProduct "
    "iSerialNumber bNumConfigurations"
)
CONFIGURATION_FIELDS = (
    "bLength bDescriptorType wTotalLength bNumInterfaces bConfigurationValue "
    "iConfiguration bmAttributes bMaxPower"
)
INTERFACE_FIELDS = (
    "bLength bDescriptorType bInterfaceNumber bAlternateSetting bNumEndpoints "
    "bInterfaceClass bInterfaceSubClass bInterfaceProtocol iInterface"
)
ENDPOINT_FIELDS = (
    "bLength bDescriptorType bEndpointAddress bmAttributes wMaxPacketSize bInterval"
)
WIDE = ("bcd", "id", "w")
# status of a request: errno and code of libusb, and its text
ERRORS = {
    -errno.EPIPE: (errno.EPIPE, -9, "Pipe error"),
    -errno.EOVERFLOW: (errno.EOVERFLOW, -8, "Overflow"),
    -errno.ESHUTDOWN: (
        errno.ENODEV,
        -4,
        "No such device (it may have been disconnected)",
    ),
    -errno.ENOENT: (errno.ENOENT, -5, "Entity not found"),
    -errno.EIO: (errno.EIO, -1, "Input/Output Error"),
}


class PyusbBackend(usb.backend.IBackend):  # type: ignore[misc]
    """What libusb would say of these devices.

    Not modelled: rights, kernel drivers, the enumeration behind a reset.
    """

    def __init__(self, sockets: Sequence[UsbSocket]) -> None:
        self._sockets = sockets

    def enumerate_devices(self) -> Iterator[UsbSocket]:
        """The devices that are plugged in."""
        return iter([one for one in self._sockets if one.live])

    def get_parent(self, dev: UsbSocket) -> None:
        """None: there is no hub."""
        return

    def get_device_descriptor(self, dev: UsbSocket) -> SimpleNamespace:
        """The descriptor, and where the device is."""
        return SimpleNamespace(
            **_fields(DEVICE_FIELDS, dev.function.DEVICE),
            **{"bus": 1, "address": dev.address, "speed": 2},
            **{"port_number": dev.address, "port_numbers": (dev.address,)},
        )

    def get_configuration_descriptor(
        self, dev: UsbSocket, config: int
    ) -> SimpleNamespace:
        """The only configuration."""
        raw = [dev.function.CONFIGURATION][config]
        return _described(CONFIGURATION_FIELDS, raw, _extras(raw, 0))

    def get_interface_descriptor(
        self, dev: UsbSocket, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        """One interface; there are no alternate settings."""
        place = [_places(dev.function.CONFIGURATION, INTERFACE)[intf]][alt]
        return _found(INTERFACE_FIELDS, dev.function.CONFIGURATION, place)

    def get_endpoint_descriptor(
        self, dev: UsbSocket, ep: int, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        """One endpoint of an interface."""
        raw = dev.function.CONFIGURATION
        starts = [*_places(raw, INTERFACE), len(split(raw))]
        places = _places(raw, ENDPOINT)
        own = [one for one in places if starts[intf] < one < starts[intf + 1]]
        found = _found(ENDPOINT_FIELDS, raw, own[ep])
        found.bRefresh = found.bSynchAddress = 0
        return found

    def open_device(self, dev: UsbSocket) -> Engine:
        """The device while it stays plugged in."""
        engine = dev.live
        if engine is None:
            raise _error(-errno.ESHUTDOWN)
        return engine

    def close_device(self, dev_handle: Engine) -> None:
        """Nothing to be done."""

    def set_configuration(self, dev_handle: Engine, config_value: int) -> None:
        """Send the request."""
        _request(dev_handle, 0x00, _requests.SET_CONFIGURATION, config_value)

    def get_configuration(self, dev_handle: Engine) -> int:
        """The number of the configuration that is set."""
        return _request(dev_handle, 0x80, _requests.GET_CONFIGURATION, 0, length=1)[0]

    def set_interface_altsetting(
        self, dev_handle: Engine, intf: int, altsetting: int
    ) -> None:
        """Send the request."""
        _request(dev_handle, 0x01, _requests.SET_INTERFACE, altsetting, intf)

    def claim_interface(self, dev_handle: Engine, intf: int) -> None:
        """Fail when the device is gone."""
        if dev_handle.gone:
            raise _error(-errno.ESHUTDOWN)

    def release_interface(self, dev_handle: Engine, intf: int) -> None:
        """Fail when the device is gone."""
        self.claim_interface(dev_handle, intf)

    def bulk_write(
        self, dev_handle: Engine, ep: int, intf: int, data: Any, timeout: int
    ) -> int:
        """How many bytes were sent."""
        sent = bytes(data)
        _transfer(dev_handle, Urb(ep, _set, data=sent), timeout)
        return len(sent)

    def bulk_read(
        self, dev_handle: Engine, ep: int, intf: int, buff: Any, timeout: int
    ) -> int:
        """How many bytes were put into ``buff``."""
        size = len(buff) * buff.itemsize
        urb = _transfer(dev_handle, Urb(ep, _set, length=size), timeout)
        buff[: len(urb.received)] = type(buff)("B", urb.received)
        return len(urb.received)

    intr_write, intr_read = bulk_write, bulk_read

    def ctrl_transfer(
        self,
        dev_handle: Engine,
        bmRequestType: int,  # noqa: N803  pyusb passes it by this name
        bRequest: int,  # noqa: N803
        wValue: int,  # noqa: N803
        wIndex: int,  # noqa: N803
        data: Any,
        timeout: int,
    ) -> int:
        """How many bytes were sent, or put into ``data``."""
        size: int = len(data) * data.itemsize
        setup = Setup(bmRequestType, bRequest, wValue, wIndex, size)
        sent = b"" if bmRequestType & IN else bytes(data)
        urb = Urb(0, _set, setup=setup, data=sent, length=size)
        _transfer(dev_handle, urb, timeout)
        if not bmRequestType & IN:
            return size
        data[: len(urb.received)] = type(data)("B", urb.received)
        return len(urb.received)

    def clear_halt(self, dev_handle: Engine, ep: int) -> None:
        """Send the request."""
        _request(dev_handle, 0x02, _requests.CLEAR_FEATURE, 0, ep)

    def reset_device(self, dev_handle: Engine) -> None:
        """Set the configuration anew, as the host does after a reset."""
        _request(dev_handle, 0x00, _requests.SET_CONFIGURATION, 1)

    def is_kernel_driver_active(self, dev_handle: Engine, intf: int) -> bool:
        """False: there is no kernel here."""
        return False

    def detach_kernel_driver(self, dev_handle: Engine, intf: int) -> None:
        """Fail: there is none."""
        raise _error(-errno.ENOENT)

    def attach_kernel_driver(self, dev_handle: Engine, intf: int) -> None:
        """Fail: there is none."""
        raise _error(-errno.ENOENT)


def _set(urb: Urb) -> None:
    """Nothing: replaced while a transfer waits."""


def _transfer(engine: Engine, urb: Urb, timeout_ms: int) -> Urb:
    finished = threading.Event()
    urb.done = lambda _: finished.set()
    engine.submit(urb)
    if not finished.wait(timeout_ms / 1000.0 if timeout_ms else None):
        taken_back = engine.unlink(urb)
        if taken_back and not urb.received:
            raise usb.core.USBTimeoutError("Operation timed out", -7, errno.ETIMEDOUT)
    if urb.status and urb.status != -errno.ECONNRESET:
        raise _error(urb.status)
    return urb


def _request(
    engine: Engine, kind: int, request: int, value: int, index: int = 0, length: int = 0
) -> bytes:
    setup = Setup(kind, request, value, index, length)
    urb = _transfer(engine, Urb(0, _set, setup=setup, length=length), 1000)
    return bytes(urb.received)


def _error(status: int) -> usb.core.USBError:
    number, code, text = ERRORS.get(status, (-status, -99, os.strerror(-status)))
    return usb.core.USBError(text, code, number)


def _fields(names: str, raw: bytes) -> dict[str, int]:
    values, at = {}, 0
    for name in names.split():
        size = 2 if name.startswith(WIDE) else 1
        values[name] = int.from_bytes(raw[at : at + size], "little")
        at += size
    return values


def _described(names: str, raw: bytes, extra: bytes) -> SimpleNamespace:
    return SimpleNamespace(**_fields(names, raw), extra_descriptors=list(extra))


def _found(names: str, configuration: bytes, place: int) -> SimpleNamespace:
    raw = split(configuration)[place]
    return _described(names, raw, _extras(configuration, place))


def _places(configuration: bytes, kind: int) -> list[int]:
    parts = split(configuration)
    return [place for place, one in enumerate(parts) if one[1] == kind]


def _extras(configuration: bytes, place: int) -> bytes:
    """The class-specific descriptors right behind a standard one."""
    extra = b""
    for one in split(configuration)[place + 1 :]:
        if one[1] in {INTERFACE, ENDPOINT}:
            break
        extra += one
    return extra
