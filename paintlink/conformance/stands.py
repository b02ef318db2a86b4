"""Ways to connect a driver with its simulator, each opened as the service opens it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from paintlink.conformance._subjects import Subject
from paintlink.errors import ConfigError
from paintlink.instrument import ByteStream
from paintlink.links import open_link

# Instrument, driver and time-outs run so many times faster where time is real: far
# enough from the pauses a busy machine makes.
HURRY = 2.0
Clock = Callable[[], float]
Build = Callable[[Clock], Any]
"""From a clock to the simulator with its fault and its operator."""


class Stand(NamedTuple):
    """An open stream to a simulator, and the clock both ends go by."""

    stream: ByteStream
    clock: Clock


@contextmanager
def in_memory(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it in this thread, with time that passes only when waited."""
    clock = subject.kit.ManualClock()
    port = subject.kit.MemoryPort(build(clock), clock, chunk_bytes=chunk or None)
    yield Stand(port, clock)
    port.close()


@contextmanager
def on_pty(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it at a pseudo-terminal."""
    with subject.kit.PtyPort(build(hurried)) as port:
        yield from _opened(subject, port.path, chunk)


@contextmanager
def on_tcp(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it at a serial device server without options."""
    with subject.kit.TcpPort(build(hurried)) as port:
        yield from _opened(subject, port.url, chunk)


@contextmanager
def on_rfc2217(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it at a serial device server that takes the line's settings."""
    with subject.kit.Rfc2217Port(build(hurried)) as port:
        yield from _opened(subject, port.url, chunk)


@contextmanager
def on_usbip(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it at a USB/IP server."""
    device = usb_device(subject, build, hurried)
    try:
        with subject.kit.UsbIpPort([device]) as port:
            yield from _opened(subject, port.url(), chunk)
    finally:
        device.close()


@contextmanager
def on_pyusb(subject: Subject, build: Build, chunk: int) -> Iterator[Stand]:
    """Open it through pyusb, with the back end of the simulators."""
    import usb.core

    from paintlink.links.usb_stream import UsbStream, claimed

    device = usb_device(subject, build, hurried)
    settings = subject.driver.INFO.usb
    if settings is None:
        msg = f"driver {subject.id} is not reached over USB"
        raise ConfigError(msg)
    found = usb.core.find(backend=subject.kit.PyusbBackend([device]))
    stream = claimed(UsbStream(found, settings, "usb://simulated"), found, "simulated")
    try:
        yield Stand(Hurried(stream, chunk), hurried)
    finally:
        stream.close()
        device.close()


Stands = Callable[[Subject, Build, int], Any]
SERIAL: Mapping[str, Stands] = {
    "memory": in_memory,
    "pty": on_pty,
    "tcp": on_tcp,
    "rfc2217": on_rfc2217,
}
USB: Mapping[str, Stands] = {"pyusb": on_pyusb, "usb+ip": on_usbip}
TRANSPORTS: dict[str, Stands] = {**SERIAL, **USB}
"""Those of the fakes; the lab adds the kernel."""


def transports_of(subject: Subject) -> list[str]:
    """The ways this driver can be connected."""
    return [*SERIAL, *(USB if subject.driver.INFO.usb else ())]


def usb_device(subject: Subject, build: Build, clock: Clock) -> Any:
    """The simulated instrument as a USB device, plugged in."""
    return subject.kit.UsbSocket(subject.simulator.usb_function(build(clock)))


class Hurried:
    """A stream whose time runs `HURRY` times faster.

    Parameters
    ----------
    chunk
        The most bytes one read returns; 0 for no limit.
    """

    def __init__(self, stream: ByteStream, chunk: int = 0) -> None:
        self._stream = stream
        self._chunk = chunk
        self._held = b""

    def write(self, data: bytes) -> None:
        """Send all of ``data``."""
        self._stream.write(data)

    def read(self, timeout_s: float) -> bytes:
        """Return what is there, at least one byte; nothing after ``timeout_s``."""
        if not self._held:
            self._held = self._stream.read(timeout_s / HURRY)
        size = self._chunk or len(self._held)
        data, self._held = self._held[:size], self._held[size:]
        return data

    def close(self) -> None:
        """Give the port back."""
        self._stream.close()


def hurried() -> float:
    """Seconds, `HURRY` of them in one."""
    return HURRY * time.monotonic()


def _opened(subject: Subject, address: str, chunk: int) -> Iterator[Stand]:
    info = subject.driver.INFO
    stream = open_link(address, info.serial, info.usb)
    try:
        yield Stand(Hurried(stream, chunk), hurried)
    finally:
        stream.close()
