"""What went wrong with a USB device, said so that the operator can put it right."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Any

from paintlink.errors import LinkError
from paintlink.links.advice import in_use, users_of

_RULE = (
    "install the udev rule once: `sudo cp 60-paintlink.rules /etc/udev/rules.d/ && "
    "sudo udevadm control --reload && sudo udevadm trigger`, then plug it out and in"
)


def node_of(device: Any) -> str:
    """Return the file the kernel shows a device as; empty when it is not local."""
    if device.bus is None or device.address is None:
        return ""
    node = Path(f"/dev/bus/usb/{device.bus:03d}/{device.address:03d}")
    return str(node) if node.exists() else ""


def problem_of(device: Any) -> str:
    """Return what keeps us from using a device; empty when nothing does."""
    node = node_of(device)
    if not node:
        return ""
    if not os.access(node, os.R_OK | os.W_OK):
        return f"no permission to open {node}: {_RULE}"
    users = tuple(user for user in users_of(node) if str(os.getpid()) not in user)
    return in_use(node, users) if users else ""


def cannot_claim(address: str, device: Any, failure: Exception) -> LinkError:
    """Return the error to raise when a device that is there cannot be used."""
    code = getattr(failure, "errno", None)
    if code in {errno.EACCES, errno.EPERM}:
        msg = f"no permission to open {address}: {_RULE}"
    elif code == errno.EBUSY:
        msg = in_use(address, users_of(node_of(device)) if node_of(device) else ())
    elif code == errno.ENODEV:
        msg = f"{address} went away while it was opened: check the USB cable"
    elif code == errno.ENOENT:
        msg = (
            f"{address} does not speak the protocol of this driver: choose another one"
        )
    else:
        msg = f"{address} cannot be opened ({failure}): plug it out and in again"
    return LinkError(msg)


def stalled(address: str) -> LinkError:
    """Return the error to raise when an endpoint refuses to go on."""
    msg = f"{address} refused a USB transfer: plug it out and in if this comes again"
    return LinkError(msg)
