"""The fakes of the USB stack give, item by item, what the real kernel gives.

The lab (`make lab`) holds the same table against real libusb.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import pytest
import usb.core

from paintlink.errors import LinkError
from paintlink.links.usbip_backend import UsbIpBackend
from paintlink.links.usbip_client import UsbIpClient
from paintlink_simulators import xrite_ma
from paintlink_simulators.ports import PyusbBackend, UsbIpPort
from paintlink_simulators.usb import UsbSocket, VendorFunction
from tests.conformance.bench import SEED, panel
from tests.conformance.usb_list import EXPECTED, observe


class InProcess:
    def __init__(self, socket: UsbSocket) -> None:
        self.socket = socket
        self._backend = PyusbBackend([socket])

    def find(self) -> Any:
        return usb.core.find(idVendor=0x1209, idProduct=1, backend=self._backend)

    def unplug(self) -> None:
        self.socket.unplug()

    def replug(self) -> None:
        self.socket.replug()


class OverUsbIp(InProcess):
    def __init__(self, socket: UsbSocket, port: UsbIpPort) -> None:
        super().__init__(socket)
        self._port = port
        self._clients: list[UsbIpClient] = []

    def find(self) -> Any:
        try:
            client = UsbIpClient(self._port.host, self._port.port, self.socket.busid)
        except LinkError:
            return None
        self._clients.append(client)
        return usb.core.find(backend=UsbIpBackend(client))

    def close(self) -> None:
        for client in self._clients:
            client.close()


@pytest.fixture
def socket() -> Iterator[UsbSocket]:
    simulator = xrite_ma.create(panel(), clock=time.monotonic, seed=SEED)
    one = UsbSocket(VendorFunction(simulator))
    yield one
    one.close()


def test_in_process_backend_is_as_the_kernel(socket: UsbSocket) -> None:
    assert observe(InProcess(socket)) == EXPECTED


def test_usbip_in_user_space_is_as_the_kernel(socket: UsbSocket) -> None:
    with UsbIpPort([socket]) as port:
        bus = OverUsbIp(socket, port)
        assert observe(bus) == EXPECTED
        bus.close()
