"""Our udev rules in force: who may open an instrument, under which lasting name."""

from __future__ import annotations

import grp
import os
import stat
import time
from pathlib import Path
from typing import Any

from paintlink_simulators import xrite_ma, xrite_rci
from paintlink_simulators.usb import FtdiFunction, UsbSocket
from tests.conformance.bench import SEED, panel
from tests.lab.vhci import Plug, wait_for

BY_ID = Path("/dev/serial/by-id")
EXPECTED = {
    "DTP20 node": "paintlink 660",
    "DTP20 kept from ModemManager": "True",
    "adapter node": "dialout 660",
    "adapter's lasting name": "usb-paintlink_sims_MA5_SIMRULES-if00-port0",
    "name while unplugged": "False",
}


def compare_rules() -> list[str]:
    """A line for each rule that is not in force; prints all."""
    seen = {**_instrument(), **_adapter()}
    lines = []
    for check, expected in EXPECTED.items():
        print(f"{check:28} {seen[check]}", flush=True)
        if seen[check] != expected:
            lines.append(f"{check}: {seen[check]}, expected {expected}")
    return lines


def _instrument() -> dict[str, str]:
    device = UsbSocket(xrite_rci.usb_function(_made(xrite_rci)))
    plug = Plug(device, 0)
    number = wait_for(lambda: _read(plug.place / "devnum"), "the number of the DTP20")
    bus = _read(plug.place / "busnum")
    node = Path(f"/dev/bus/usb/{int(bus):03}/{int(number):03}")
    minor = os.minor(wait_for(lambda: node.exists() and node.stat(), "node").st_rdev)
    record = Path(f"/run/udev/data/c189:{minor}")
    told = wait_for(lambda: _read(record), "what udev knows of the DTP20")
    seen = {
        "DTP20 node": _rights(node),
        "DTP20 kept from ModemManager": str("ID_MM_DEVICE_IGNORE=1" in told),
    }
    plug.forget()
    return seen


def _adapter() -> dict[str, str]:
    function = FtdiFunction(_made(xrite_ma), serial="SIMRULES")
    plug = Plug(UsbSocket(function), 0)
    # udev makes the link under a name that begins with a dot and then renames it.
    link = wait_for(
        lambda: next(iter(BY_ID.glob("[!.]*SIMRULES*")), None), "the by-id link"
    )
    seen = {
        "adapter node": _rights(link.resolve()),
        "adapter's lasting name": link.name,
    }
    plug.forget()
    end = time.monotonic() + 5.0
    while link.is_symlink() and time.monotonic() < end:
        time.sleep(0.05)
    return seen | {"name while unplugged": str(link.is_symlink())}


def _rights(node: Path) -> str:
    status = node.stat()
    group = grp.getgrgid(status.st_gid).gr_name
    return f"{group} {stat.S_IMODE(status.st_mode):o}"


def _read(path: Path) -> str:
    try:
        return path.read_text().strip()
    except OSError:
        return ""


def _made(module: Any) -> Any:
    return module.create(panel(), clock=time.monotonic, seed=SEED)
