"""A back end of pyusb over USB/IP: no kernel module, no rights on this machine."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import usb.backend
import usb.core

from paintlink.errors import LinkError
from paintlink.instrument import UsbSettings
from paintlink.links import descriptors
from paintlink.links.addresses import parse_usbip
from paintlink.links.advice import FAILURES
from paintlink.links.usb_stream import UsbStream, claimed
from paintlink.links.usbip_client import UsbIpClient

_SETUP = struct.Struct("<BBHHH")
_CONTROL_MS = 2000
_GET_DESCRIPTOR, _GET_CONFIGURATION, _SET_CONFIGURATION = 6, 8, 9
_SET_INTERFACE, _CLEAR_FEATURE = 11, 1


class UsbIpBackend(usb.backend.IBackend):  # type: ignore[misc]
    """What pyusb asks a back end, for the one imported device."""

    def __init__(self, client: UsbIpClient) -> None:
        self._client = client
        place = client.device
        self._device = descriptors.device_descriptor(
            self._descriptor(1, 0, descriptors.DEVICE_SIZE),
            bus=place.busnum,
            address=place.devnum,
            port_number=1,
            port_numbers=(1,),
            speed=place.speed,
        )
        self._configurations = [
            self._read_configuration(index)
            for index in range(self._device.bNumConfigurations)
        ]

    def enumerate_devices(self) -> Iterator[UsbIpClient]:
        yield self._client

    def get_parent(self, dev: object) -> None:
        return None

    def get_device_descriptor(self, dev: object) -> SimpleNamespace:
        return self._device

    def get_configuration_descriptor(self, dev: object, config: int) -> SimpleNamespace:
        return self._configurations[config].descriptor

    def get_interface_descriptor(
        self, dev: object, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        return self._configurations[config].setting(intf, alt).descriptor

    def get_endpoint_descriptor(
        self, dev: object, ep: int, intf: int, alt: int, config: int
    ) -> SimpleNamespace:
        return self._configurations[config].setting(intf, alt).endpoints[ep]

    def open_device(self, dev: UsbIpClient) -> UsbIpClient:
        return dev

    def close_device(self, dev_handle: object) -> None:
        self._client.close()

    def set_configuration(self, dev_handle: object, config_value: int) -> None:
        self._control(0x00, _SET_CONFIGURATION, config_value, 0, b"")

    def get_configuration(self, dev_handle: object) -> int:
        return self._control(0x80, _GET_CONFIGURATION, 0, 0, 1)[0]

    def set_interface_altsetting(
        self, dev_handle: object, intf: int, altsetting: int
    ) -> None:
        self._control(0x01, _SET_INTERFACE, altsetting, intf, b"")

    def claim_interface(self, dev_handle: object, intf: int) -> None:
        """Do nothing: the whole device was imported."""

    def release_interface(self, dev_handle: object, intf: int) -> None:
        """Do nothing, as `claim_interface`."""

    def is_kernel_driver_active(self, dev_handle: object, intf: int) -> bool:
        return False

    def bulk_write(
        self, dev_handle: object, ep: int, intf: int, data: Any, timeout: int
    ) -> int:
        sent = bytes(data)
        return self._client.transfer(
            ep & 0x7F, length=len(sent), timeout_ms=timeout, data=sent
        )[0]

    def bulk_read(
        self, dev_handle: object, ep: int, intf: int, buff: Any, timeout: int
    ) -> int:
        size = len(buff) * buff.itemsize
        _, data = self._client.transfer(ep | 0x80, length=size, timeout_ms=timeout)
        buff[: len(data)] = type(buff)("B", data)
        return len(data)

    intr_write, intr_read = bulk_write, bulk_read

    def ctrl_transfer(
        self,
        dev_handle: object,
        bmRequestType: int,  # noqa: N803  pyusb passes it by this name
        bRequest: int,  # noqa: N803
        wValue: int,  # noqa: N803
        wIndex: int,  # noqa: N803
        data: Any,
        timeout: int,
    ) -> int:
        size = len(data) * data.itemsize
        setup = _SETUP.pack(bmRequestType, bRequest, wValue, wIndex, size)
        length, came = self._client.transfer(
            bmRequestType & 0x80,
            length=size,
            timeout_ms=timeout,
            setup=setup,
            data=bytes(data),
        )
        if bmRequestType & 0x80:
            data[: len(came)] = type(data)("B", came)
            return len(came)
        return length

    def clear_halt(self, dev_handle: object, ep: int) -> None:
        self._control(0x02, _CLEAR_FEATURE, 0, ep, b"")

    def reset_device(self, dev_handle: object) -> None:
        """Do nothing: USB/IP has no such message outside the kernel."""

    def _control(
        self, kind: int, request: int, value: int, index: int, out: bytes | int
    ) -> bytes:
        size = out if isinstance(out, int) else len(out)
        return self._client.transfer(
            kind & 0x80,
            length=size,
            timeout_ms=_CONTROL_MS,
            setup=_SETUP.pack(kind, request, value, index, size),
            data=b"" if isinstance(out, int) else out,
        )[1]

    def _descriptor(self, kind: int, index: int, size: int) -> bytes:
        return self._control(0x80, _GET_DESCRIPTOR, kind << 8 | index, 0, size)

    def _read_configuration(self, index: int) -> descriptors.Configuration:
        head = self._descriptor(2, index, descriptors.CONFIGURATION_SIZE + 1)
        total = int.from_bytes(head[2:4], "little")
        return descriptors.parse_configuration(self._descriptor(2, index, total))


def open_usbip(address: str, settings: UsbSettings) -> UsbStream:
    """Return the claimed instrument at ``usb+ip://host:port/busid``.

    Raises
    ------
    LinkError
        With the next step for the operator.
    """
    client = UsbIpClient(*parse_usbip(address))
    try:
        backend = UsbIpBackend(client)
        device = usb.core.find(backend=backend)
    except (*FAILURES, struct.error) as failure:
        client.close()
        msg = f"{address} sent no usable USB descriptors ({failure}): start it again"
        raise LinkError(msg) from failure
    if (device.idVendor, device.idProduct) != (settings.vendor_id, settings.product_id):
        client.close()
        msg = (
            f"{address} is a device {device.idVendor:04x}:{device.idProduct:04x}, this "
            f"driver is for {settings.usb_id}: choose another bus id or driver"
        )
        raise LinkError(msg)
    stream = UsbStream(device, settings, address, on_close=client.close)
    return claimed(stream, device, address)
