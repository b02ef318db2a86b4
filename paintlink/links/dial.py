"""One way to open every address."""

from __future__ import annotations

from paintlink.errors import LinkError
from paintlink.instrument import ByteStream, SerialSettings, UsbSettings
from paintlink.links.addresses import kind_of
from paintlink.links.stream import open_serial


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
