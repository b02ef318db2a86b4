"""ModemManager opens serial ports it takes for modems, and talks to what is there."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

PROC, UDEV = Path("/proc"), Path("/run/udev/data")
_IGNORED = ("E:ID_MM_PORT_IGNORE=1", "E:ID_MM_DEVICE_IGNORE=1")


def disturbs(device: str, *, proc: Path = PROC, udev: Path = UDEV) -> str:
    """Return what to do when ModemManager may talk to a port; empty when it does not.

    Parameters
    ----------
    proc, udev
        Where the kernel shows processes and udev keeps what it knows of devices.
    """
    if not _runs(proc) or _told_to_ignore(device, udev):
        return ""
    return (
        f"ModemManager may talk to {device}: run `sudo systemctl disable --now "
        "ModemManager`, or give the adapter the line for ModemManager in "
        "60-paintlink.rules"
    )


def _runs(proc: Path) -> bool:
    return any(_read(one) == "ModemManager\n" for one in _names(proc))


def _names(proc: Path) -> Iterable[Path]:
    try:
        return [one / "comm" for one in proc.iterdir() if one.name.isdigit()]
    except OSError:
        return []


def _told_to_ignore(device: str, udev: Path) -> bool:
    try:
        number = Path(device).stat().st_rdev
    except OSError:
        return True
    known = _read(udev / f"c{os.major(number)}:{os.minor(number)}").splitlines()
    return any(line in known for line in _IGNORED)


def _read(path: Path) -> str:
    try:
        return path.read_text(errors="replace")
    except OSError:
        return ""
