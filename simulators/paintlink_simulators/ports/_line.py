"""What a served simulator can be plugged into."""

from __future__ import annotations

from typing import Protocol

from paintlink_simulators._uart import LineSettings


class Line(Protocol):
    """A connection that never blocks; what fails is an ``OSError``."""

    def fileno(self) -> int:
        """The descriptor to wait on."""
        ...

    def receive(self) -> bytes:
        """What has arrived; nothing at all means that the other end has gone."""
        ...

    def send(self, data: bytes) -> int:
        """How many of the bytes were taken."""
        ...

    def host_line(self) -> LineSettings | None:
        """How the other end is set; None where that cannot be seen."""
        ...

    def close(self) -> None:
        """Leave nothing open."""


class Listener(Protocol):
    """Where other ends connect by themselves."""

    def fileno(self) -> int:
        """The descriptor to wait on."""
        ...

    def accept(self) -> Line:
        """The line to the end that has connected."""
        ...

    def close(self) -> None:
        """Accept nobody any more."""
