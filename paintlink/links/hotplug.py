"""Hints that a device came or went; the truth is an identity reply."""

from __future__ import annotations

import contextlib
import select
import socket
import time
from collections.abc import Iterable
from pathlib import Path

from serial.tools import list_ports

_UEVENT_PROTOCOL = 15
_KERNEL_GROUP = 1
SCAN_EVERY_S = 2.0
GLANCE_EVERY_S = 0.25

Snapshot = frozenset[tuple[str, int, int]]


class Hotplug:
    """Tells when devices may have changed: kernel events, and the difference of scans.

    Parameters
    ----------
    addresses
        What is configured: devices, patterns with ``*``, or URLs, which cannot be seen.
    """

    def __init__(self, addresses: Iterable[str]) -> None:
        self._patterns = tuple(one for one in addresses if "://" not in one)
        self._events = _kernel_events()
        self._names = self._glance()
        self._ports = _scan()
        self._scanned_s = time.monotonic()

    def wait(self) -> bool:
        """Return within 0.25 s whether something changed since the last call.

        The configured names are looked at each time, every port of the machine every
        2 s, and at once after an event of the kernel.
        """
        heard = self._hear(GLANCE_EVERY_S)
        names, before = self._glance(), (self._names, self._ports)
        if heard or time.monotonic() - self._scanned_s >= SCAN_EVERY_S:
            self._ports = _scan()
            self._scanned_s = time.monotonic()
        self._names = names
        return (self._names, self._ports) != before

    def close(self) -> None:
        """Stop listening."""
        if self._events is not None:
            self._events.close()

    def _hear(self, timeout_s: float) -> bool:
        if self._events is None:
            time.sleep(timeout_s)
            return False
        ready, _, _ = select.select([self._events], [], [], timeout_s)
        if ready:
            with contextlib.suppress(OSError):
                while self._events.recv(8192):
                    pass
        return bool(ready)

    def _glance(self) -> Snapshot:
        found = (name for pattern in self._patterns for name in matches(pattern))
        return frozenset(filter(None, map(_trace, found)))


def matches(pattern: str) -> list[str]:
    """Return the devices a name stands for: itself, or all that fit its ``*``."""
    if "*" not in pattern:
        return [pattern]
    folder, name = Path(pattern).parent, Path(pattern).name
    return sorted(str(found) for found in folder.glob(name))


def _trace(name: str) -> tuple[str, int, int] | None:
    """What tells a device from the one that had its name before."""
    try:
        status = Path(name).stat()
    except OSError:
        return None
    return name, status.st_rdev, status.st_ctime_ns


def _scan() -> frozenset[str]:
    return frozenset(port.device for port in list_ports.comports())


def _kernel_events() -> socket.socket | None:
    """A socket on which the kernel tells of devices; None where that is forbidden."""
    try:
        events = socket.socket(
            socket.AF_NETLINK,
            socket.SOCK_DGRAM | socket.SOCK_NONBLOCK,
            _UEVENT_PROTOCOL,
        )
        events.bind((0, _KERNEL_GROUP))
    except OSError:
        return None
    return events
