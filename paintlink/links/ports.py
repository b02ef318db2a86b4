"""Serial ports of this machine, seen without opening them."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

from serial.tools import list_ports
from serial.tools.list_ports_common import ListPortInfo

from paintlink.links.advice import in_use, no_permission, users_of

BY_ID = Path("/dev/serial/by-id")
# Linux gives pseudo-terminals these device numbers, whatever their name is.
_PTY_MAJORS = range(136, 144)
_LOOPBACK = re.compile(
    r"(?:socket|rfc2217|usb\+ip)://(?:127(?:\.\d{1,3}){3}|localhost|\[::1\])[:/]",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class PortInfo:
    """One serial port.

    Parameters
    ----------
    by_id
        The name that stays the same when the adapter moves to another socket; empty
        when there is none.
    usb_id
        Vendor and product, ``0403:6001``; empty for a port that is not on USB.
    problem
        What keeps us from opening it and what to do; empty when nothing does.
    """

    device: str
    by_id: str
    usb_id: str
    serial_number: str
    description: str
    problem: str


def candidates(by_id: Path = BY_ID) -> tuple[PortInfo, ...]:
    """Return every serial port an instrument may be at, by name."""
    found = sorted(list_ports.comports(), key=lambda port: port.device)
    return tuple(describe(port, by_id) for port in found)


def describe(port: ListPortInfo, by_id: Path = BY_ID) -> PortInfo:
    """Return what is known of a port; it is not opened."""
    usb_id = "" if port.vid is None else f"{port.vid:04x}:{port.pid:04x}"
    return PortInfo(
        device=port.device,
        by_id=_lasting_name(port.device, by_id),
        usb_id=usb_id,
        serial_number=port.serial_number or "",
        description="" if port.description == "n/a" else port.description,
        problem=_problem(port.device),
    )


def is_simulated_path(path: str) -> bool:
    """Return whether a simulator must be behind an address.

    No instrument is behind a pseudo-terminal, nor at this computer's own network
    address: what is plugged in here is opened by its device.
    """
    if _LOOPBACK.match(path):
        return True
    real = Path(path).resolve()
    try:
        numbered = os.major(real.stat().st_rdev) in _PTY_MAJORS
    except OSError:
        numbered = False
    return numbered or real.is_relative_to("/dev/pts")


def _lasting_name(device: str, by_id: Path) -> str:
    try:
        links = sorted(by_id.iterdir())
    except OSError:
        # The folder exists only while an adapter is plugged in.
        return ""
    real = Path(device).resolve()
    return next((str(link) for link in links if link.resolve() == real), "")


def _problem(device: str) -> str:
    if not os.access(device, os.R_OK | os.W_OK):
        return no_permission(device)
    users = users_of(device)
    return in_use(device, users) if users else ""
