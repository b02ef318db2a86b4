"""Faults in how and when an answer arrives; its bytes are untouched."""

from __future__ import annotations

from collections import deque

from paintlink_simulators._simulator import (
    LineCutError,
    Simulator,
    Wrapper,
    earlier,
)


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
