"""The real USB of this machine, through libusb."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import usb.backend.libusb1

from paintlink.errors import LinkError

NO_LIBUSB = (
    "USB instruments need libusb, which is not installed: run "
    "`sudo apt install libusb-1.0-0`"
)


def libusb() -> object:
    """Return a fresh back end on libusb.

    It is fresh because a list of devices is frozen at its first use where no udev runs,
    as in a container.

    Raises
    ------
    LinkError
        When the library is not installed.
    """
    found = usb.backend.libusb1.get_backend()
    if found is None:
        raise LinkError(NO_LIBUSB)
    return OrderlyBackend(found.lib)


class OrderlyBackend(usb.backend.libusb1._LibUSB):  # type: ignore[misc]  # noqa: SLF001
    """pyusb's back end, whose context ends after the devices it has listed.

    pyusb drops a device after the context it belongs to. libusb then writes to memory
    it has freed, and crashes once in a while when an instrument was unplugged.
    """

    def __init__(self, lib: Any) -> None:
        self._listed: list[Any] = []
        super().__init__(lib)

    def enumerate_devices(self) -> Iterable[Any]:
        """Every device on the bus."""
        listed = list(super().enumerate_devices())
        self._listed += listed
        return listed

    def _finalize_object(self) -> None:
        for device in self._listed:
            device.finalize()
        super()._finalize_object()
