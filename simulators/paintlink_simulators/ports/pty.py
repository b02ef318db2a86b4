"""A simulator behind a pseudo-terminal: opened by name, like a serial port."""

from __future__ import annotations

import os
import re
import termios
import tty
from pathlib import Path

from paintlink_simulators._simulator import Simulator
from paintlink_simulators._uart import LineSettings
from paintlink_simulators.ports.server import Server

RATES = {
    getattr(termios, name): float(name[1:])
    for name in dir(termios)
    if re.fullmatch(r"B[1-9]\d*", name)
}


class PtyPort(Server):
    """A simulator at a terminal device that can be unplugged.

    Parameters
    ----------
    link
        A symbolic link that names the device while it is plugged in, as
        ``/dev/serial/by-id`` does.
    """

    def __init__(
        self,
        simulator: Simulator,
        *,
        link: Path | None = None,
        baud: int | None = None,
        auto_press_after_s: float | None = None,
        line: LineSettings | None = None,
    ) -> None:
        super().__init__(
            simulator, baud=baud, auto_press_after_s=auto_press_after_s, line=line
        )
        self._link = link
        self.path = ""
        try:
            self.replug()
        except OSError:
            self.close()
            raise

    def unplug(self) -> None:
        """Close the device: whoever has it open reads EOF or gets EIO."""
        self._unplug()

    def replug(self) -> str:
        """The path of a new device, never the one before; the link points to it.

        Nothing asked for before is answered on it.
        """
        self._unplug()
        terminal = _Terminal(self._link, avoid=self.path)
        self._plug(terminal)
        self.path = terminal.path
        return self.path


class _Terminal:
    """Both ends of a pseudo-terminal and the link to it.

    The far end stays open here as well: otherwise reading the near end fails as soon
    as a client closes.
    """

    def __init__(self, link: Path | None, avoid: str) -> None:
        self._near, self._far = _open_pair(avoid)
        self.path = os.ttyname(self._far)
        self._link = link
        try:
            self._name()
        except OSError:
            self.close()
            raise

    def fileno(self) -> int:
        return self._near

    def receive(self) -> bytes:
        return os.read(self._near, 4096)

    def send(self, data: bytes) -> int:
        return os.write(self._near, data)

    def host_line(self) -> LineSettings | None:
        """The rate a client has set; data bits and parity cannot be seen here."""
        rate = RATES.get(termios.tcgetattr(self._far)[5])
        return None if rate is None else LineSettings(rate)

    def close(self) -> None:
        if self._link is not None:
            self._link.unlink(missing_ok=True)
        os.close(self._far)
        os.close(self._near)

    def _name(self) -> None:
        if self._link is not None:
            waiting = self._link.with_name(f".{self._link.name}.new")
            waiting.unlink(missing_ok=True)
            waiting.symlink_to(self.path)
            waiting.replace(self._link)


def _open_pair(avoid: str) -> tuple[int, int]:
    """Raw, the near end not blocking, at any path but ``avoid``."""
    near, far = os.openpty()
    if os.ttyname(far) == avoid:
        # The kernel gives out the lowest free number: hold this one meanwhile.
        try:
            return _open_pair("")
        finally:
            os.close(far)
            os.close(near)
    tty.setraw(near)
    tty.setraw(far)
    os.set_blocking(near, False)
    return near, far
