"""Faults in how and when an answer arrives; its bytes are untouched."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from paintlink_simulators._simulator import (
    LineCutError,
    Simulator,
    Wrapper,
    earlier,
)
from paintlink_simulators._uart import LineSettings, heard


class Late(Wrapper):
    """Every answer comes ``delay_s`` later than it should."""

    def __init__(self, inner: Simulator, delay_s: float) -> None:
        super().__init__(inner)
        self._delay_s = delay_s
        self._held: deque[tuple[float, bytes]] = deque()

    def due_at(self) -> float | None:
        held = self._held[0][0] if self._held else None
        return earlier(self.inner.due_at(), held)

    def disconnect(self) -> None:
        self._held.clear()
        super().disconnect()

    def _pass(self, answer: bytes) -> bytes:
        now = self.clock()
        if answer:
            self._held.append((now + self._delay_s, answer))
        due = b""
        while self._held and self._held[0][0] <= now:
            due += self._held.popleft()[1]
        return due


class Chunked(Wrapper):
    """Answers come in pieces of at most ``size`` bytes, one for each poll."""

    def __init__(self, inner: Simulator, size: int) -> None:
        super().__init__(inner)
        self._size = size
        self._held = b""

    def due_at(self) -> float | None:
        return self.clock() if self._held else self.inner.due_at()

    def disconnect(self) -> None:
        self._held = b""
        super().disconnect()

    def _pass(self, answer: bytes) -> bytes:
        held = self._held + answer
        self._held = held[self._size :]
        return held[: self._size]


class ClosedAfter(Wrapper):
    """The line is cut, once, when ``count`` bytes have been sent."""

    def __init__(self, inner: Simulator, count: int) -> None:
        super().__init__(inner)
        self._left: int | None = count

    def _pass(self, answer: bytes) -> bytes:
        if self._left is None:
            return answer
        if len(answer) < self._left:
            self._left -= len(answer)
            return answer
        sent, self._left = answer[: self._left], None
        raise LineCutError(sent)


class Echoing(Wrapper):
    """Everything received comes back before the answer, as a half-duplex line does."""

    def feed(self, data: bytes) -> bytes:
        return data + self.inner.feed(data)


class Onset(Wrapper):
    """A sound line for the first ``answers`` answers, the faulty one from then on.

    ``faulty`` is a fault around the simulator ``sound``.
    """

    def __init__(self, sound: Simulator, faulty: Simulator, answers: int) -> None:
        super().__init__(sound if answers else faulty)
        self._faulty = faulty
        self._answers_left = answers

    def _pass(self, answer: bytes) -> bytes:
        if answer and self._answers_left:
            self._answers_left -= 1
            if not self._answers_left:
                self.inner = self._faulty
        return answer


class DeafAtFirst(Wrapper):
    """The first thing said to it is lost, as to a sleeping instrument."""

    def __init__(self, inner: Simulator) -> None:
        super().__init__(inner)
        self._deaf = True

    def feed(self, data: bytes) -> bytes:
        deaf, self._deaf = self._deaf, False
        return b"" if deaf else super().feed(data)


class WrongBaud(Wrapper):
    """The host's end of the line is set to another baud rate than the instrument's."""

    def __init__(self, inner: Simulator, instrument: float, host: float) -> None:
        super().__init__(inner)
        self._instrument, self._host = LineSettings(instrument), LineSettings(host)

    def feed(self, data: bytes) -> bytes:
        return super().feed(heard(data, self._host, self._instrument))

    def _pass(self, answer: bytes) -> bytes:
        return heard(answer, self._instrument, self._host)


class Recurring(Wrapper):
    """Something is sent by itself, again and again, from the first poll on.

    Parameters
    ----------
    send
        What, given the simulator.
    alone
        Whether it is all that is ever sent.
    """

    def __init__(
        self,
        inner: Simulator,
        every_s: float,
        send: Callable[[Simulator], bytes],
        *,
        alone: bool = False,
    ) -> None:
        super().__init__(inner)
        self._every_s = every_s
        self._send = send
        self._alone = alone
        self._next: float | None = None

    def due_at(self) -> float | None:
        return earlier(self.inner.due_at(), self._next)

    def disconnect(self) -> None:
        self._next = None
        super().disconnect()

    def _pass(self, answer: bytes) -> bytes:
        now = self.clock()
        sent = b"" if self._alone else answer
        if self._next is None:
            self._next = now + self._every_s
        if self._next <= now:
            self._next = now + self._every_s
            sent += self._send(self.inner)
        return sent
