"""Instruments on USB that are no serial port, through pyusb and any back end of it."""

from __future__ import annotations

import contextlib
import errno
import math
import time
from collections.abc import Callable
from typing import Any

import usb.core
import usb.util

from paintlink.errors import LinkError, LinkTimeoutError
from paintlink.instrument import UsbSettings
from paintlink.links.addresses import parse_usb
from paintlink.links.advice import FAILURES, lost
from paintlink.links.libusb_backend import libusb
from paintlink.links.usb_advice import cannot_claim, stalled
from paintlink.links.usb_devices import find_device

_WRITE_TIMEOUT_MS = 2000
# A buffer below the size of an arriving packet loses the packet.
_PACKETS = 64
_STALE_READS = 64


class UsbStream:
    """The bytes of one claimed USB interface.

    Parameters
    ----------
    device
        A device of pyusb.
    on_close
        Called once after the interface was given back.
    """

    def __init__(
        self,
        device: Any,
        settings: UsbSettings,
        address: str,
        *,
        on_close: Callable[[], None] = lambda: None,
    ) -> None:
        self._device = device
        self._settings = settings
        self._address = address
        self._on_close = on_close
        self._detached = False
        self._size = 0

    def claim(self) -> None:
        """Take the interface and drop what an earlier session left unread."""
        self._detach_kernel()
        self._configure()
        usb.util.claim_interface(self._device, self._settings.interface)
        self._size = _PACKETS * self._packet_size()
        for _ in range(_STALE_READS):
            if not self.read(0.0):
                return

    def write(self, data: bytes) -> None:
        """Send all of ``data``.

        Raises
        ------
        LinkTimeoutError
            When the instrument takes nothing for 2 s.
        LinkError
            When the instrument is gone or refuses the transfer.
        """
        try:
            self._transfer(data)
        except usb.core.USBTimeoutError as failure:
            msg = (
                f"{self._address} takes no more bytes: switch the instrument off and on"
            )
            raise LinkTimeoutError(msg) from failure
        except FAILURES as failure:
            raise self._failed(failure) from failure

    def read(self, timeout_s: float) -> bytes:
        """Return what is there, at least one byte; nothing after ``timeout_s``.

        Raises
        ------
        LinkError
            When the instrument is gone or refuses the transfer.
        """
        deadline = time.monotonic() + timeout_s
        while True:
            try:
                data = self._receive(deadline - time.monotonic())
            except usb.core.USBTimeoutError:
                data = b""
            except FAILURES as failure:
                raise self._failed(failure) from failure
            if data or time.monotonic() >= deadline:
                return data

    def close(self) -> None:
        """Give the interface back; never fails."""
        interface = self._settings.interface
        with contextlib.suppress(*FAILURES):
            usb.util.release_interface(self._device, interface)
        if self._detached:
            with contextlib.suppress(*FAILURES, NotImplementedError):
                self._device.attach_kernel_driver(interface)
        with contextlib.suppress(*FAILURES):
            usb.util.dispose_resources(self._device)
        self._on_close()

    def _transfer(self, data: bytes) -> None:
        endpoint = self._settings.out_endpoint
        if endpoint is None:
            request = self._settings.control_request
            done = self._device.ctrl_transfer(*request, data, _WRITE_TIMEOUT_MS)
        else:
            done = self._device.write(endpoint, data, _WRITE_TIMEOUT_MS)
        if done != len(data):
            raise OSError(errno.EIO, f"{done} of {len(data)} bytes were taken")

    def _receive(self, timeout_s: float) -> bytes:
        # A time-out of 0 would wait for ever.
        wait_ms = max(1, math.ceil(1000.0 * timeout_s))
        endpoint = self._settings.in_endpoint
        return bytes(self._device.read(endpoint, self._size, wait_ms))

    def _failed(self, failure: Exception) -> LinkError:
        if getattr(failure, "errno", None) != errno.EPIPE:
            return lost(self._address, failure)
        with contextlib.suppress(*FAILURES):
            self._device.clear_halt(self._settings.in_endpoint)
        return stalled(self._address)

    def _detach_kernel(self) -> None:
        interface = self._settings.interface
        with contextlib.suppress(NotImplementedError):
            if self._device.is_kernel_driver_active(interface):
                self._device.detach_kernel_driver(interface)
                self._detached = True

    def _configure(self) -> None:
        wanted = self._settings.configuration
        try:
            active = self._device.get_active_configuration().bConfigurationValue
        except usb.core.USBError:
            active = 0
        # Setting it once more would reset an instrument that works.
        if active != wanted:
            self._device.set_configuration(wanted)

    def _packet_size(self) -> int:
        configuration = self._device.get_active_configuration()
        interface = configuration[self._settings.interface, 0]
        for endpoint in interface:
            if endpoint.bEndpointAddress == self._settings.in_endpoint:
                return max(1, int(endpoint.wMaxPacketSize) & 0x7FF)
        msg = f"no endpoint {self._settings.in_endpoint:02x}"
        raise OSError(errno.ENOENT, msg)


def open_usb(
    address: str, settings: UsbSettings, *, backend: object | None = None
) -> UsbStream:
    """Return the claimed instrument at ``usb://VID:PID/SERIAL``.

    Parameters
    ----------
    backend
        A back end of pyusb; libusb when left out.

    Raises
    ------
    LinkError
        With the next step for the operator.
    """
    vendor, product, serial = parse_usb(address)
    device = find_device(backend or libusb(), vendor, product, serial, address=address)
    return claimed(UsbStream(device, settings, address), device, address)


def claimed(stream: UsbStream, device: Any, address: str) -> UsbStream:
    """Return ``stream`` once its interface is taken; it is closed when that fails."""
    try:
        stream.claim()
    except FAILURES as failure:
        stream.close()
        raise cannot_claim(address, device, failure) from failure
    except LinkError:
        stream.close()
        raise
    return stream
