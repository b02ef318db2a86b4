"""What every simulated instrument offers, and a wrapper that passes all of it on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from paintlink.errors import LinkError
from paintlink_simulators.paint import Panel

Clock = Callable[[], float]


class LineCutError(LinkError):
    """Close the line: the instrument has left it after sending ``sent``."""

    def __init__(self, sent: bytes) -> None:
        self.sent = sent
        super().__init__(f"the simulated line was cut after {len(sent)} more bytes")


class Simulator(Protocol):
    """An instrument as a function of bytes; its time is ``clock``, in seconds.

    ``panel`` is what it stands on, ``plate_on`` whether that is its white plaque
    instead. Whatever it waits for, one press ends the waiting.
    """

    panel: Panel
    plate_on: bool

    @property
    def clock(self) -> Clock:
        """The clock everything it does later goes by."""

    @property
    def armed(self) -> bool:
        """Whether it waits for a press to measure."""

    @property
    def awaits_plate(self) -> bool:
        """Whether it waits for a press on its white plaque."""

    def feed(self, data: bytes) -> bytes:
        """The bytes it sends at once on receiving ``data``."""

    def press(self) -> bytes:
        """The bytes it sends when the operator presses it down."""

    def poll(self) -> bytes:
        """The bytes that have become due by the clock."""

    def due_at(self) -> float | None:
        """The time at which `poll` will have something to do, if that is known."""

    def disconnect(self) -> None:
        """Forget the unfinished command and every answer still owed."""


class Wrapper:
    """A simulator around another one; what `_pass` returns is what gets out.

    `_pass` is called after every call of the inner simulator, with nothing as well.
    """

    def __init__(self, inner: Simulator) -> None:
        self.inner = inner

    @property
    def clock(self) -> Clock:
        return self.inner.clock

    @property
    def panel(self) -> Panel:
        return self.inner.panel

    @panel.setter
    def panel(self, panel: Panel) -> None:
        self.inner.panel = panel

    @property
    def plate_on(self) -> bool:
        return self.inner.plate_on

    @plate_on.setter
    def plate_on(self, plate_on: bool) -> None:
        self.inner.plate_on = plate_on

    @property
    def armed(self) -> bool:
        return self.inner.armed

    @property
    def awaits_plate(self) -> bool:
        return self.inner.awaits_plate

    def feed(self, data: bytes) -> bytes:
        return self._pass(self.inner.feed(data))

    def press(self) -> bytes:
        return self._pass(self.inner.press())

    def poll(self) -> bytes:
        return self._pass(self.inner.poll())

    def due_at(self) -> float | None:
        return self.inner.due_at()

    def disconnect(self) -> None:
        self.inner.disconnect()

    def _pass(self, answer: bytes) -> bytes:
        return answer


def earlier(one: float | None, other: float | None) -> float | None:
    """The earlier of two times, either of which may be unknown."""
    if one is None or other is None:
        return other if one is None else one
    return min(one, other)
