"""What the service tells systemd: ready, alive, busy with, stopping."""

from __future__ import annotations

import logging
import os
import socket
from collections.abc import Mapping

log = logging.getLogger(__name__)

SEND_TIMEOUT_S = 1.0


class Notifier:
    """Sends notifications to systemd, or nowhere when systemd did not start us.

    ``watchdog_interval_s`` is how often `watchdog` has to be called: half of what
    systemd waits for; None when it does not wait.

    References
    ----------
    sd_notify(3) and sd_watchdog_enabled(3).
    """

    def __init__(self, environ: Mapping[str, str]) -> None:
        self._address = _address(environ.get("NOTIFY_SOCKET", ""))
        self.watchdog_interval_s = _watchdog_interval_s(environ)

    def ready(self, status: str) -> None:
        """Tell that the start is complete."""
        self._send("READY=1", f"STATUS={_one_line(status)}")

    def status(self, text: str) -> None:
        """Tell what the service is doing; `systemctl status` shows it."""
        self._send(f"STATUS={_one_line(text)}")

    def watchdog(self) -> None:
        """Tell that work goes on; call it after real progress only."""
        self._send("WATCHDOG=1")

    def stopping(self) -> None:
        """Tell that the service is on its way out."""
        self._send("STOPPING=1")

    def _send(self, *assignments: str) -> None:
        if self._address is None:
            return
        data = "\n".join(assignments).encode("utf-8", "replace")
        try:
            with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as channel:
                channel.settimeout(SEND_TIMEOUT_S)
                channel.sendto(data, self._address)
        except OSError as error:
            log.warning("systemd could not be told %s: %s", assignments[0], error)


def _address(name: str) -> bytes | None:
    """Address of a socket in the file system or, after ``@``, in no file system."""
    if name.startswith("@"):
        return b"\0" + os.fsencode(name[1:])
    return os.fsencode(name) if name.startswith("/") else None


def _watchdog_interval_s(environ: Mapping[str, str]) -> float | None:
    microseconds = environ.get("WATCHDOG_USEC", "")
    ours = environ.get("WATCHDOG_PID", str(os.getpid())) == str(os.getpid())
    if not ours or not microseconds.isdecimal() or int(microseconds) == 0:
        return None
    return int(microseconds) / 2e6


def _one_line(text: str) -> str:
    return " ".join(text.split())
