"""A simulator in the same thread, with time that passes only when told."""

from __future__ import annotations

from collections.abc import Callable

from paintlink.errors import LinkError
from paintlink_simulators._simulator import LineCutError, Simulator
from paintlink_simulators.faults import Chunked

# Real reads take time too: whoever waits for the rounded sum of two times would
# otherwise wait for ever.
SHORTEST_READ_S = 1e-6


class ManualClock:
    """Seconds that pass only when told; call it to read it."""

    def __init__(self, now_s: float = 0.0) -> None:
        self._now_s = now_s

    def __call__(self) -> float:
        """The time in seconds."""
        return self._now_s

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        self.advance_to(self._now_s + seconds)

    def advance_to(self, time_s: float) -> None:
        """Let time pass until exactly ``time_s``; it never runs backwards."""
        self._now_s = max(self._now_s, time_s)


class MemoryPort:
    """A byte stream to a simulator, without threads.

    Parameters
    ----------
    clock
        The clock of the simulator. With it a read takes the time it waits, so that
        waiting costs nothing and time-outs come true; without it no time passes.
    chunk_bytes
        The most that one read returns.
    """

    def __init__(
        self,
        simulator: Simulator,
        clock: ManualClock | None = None,
        *,
        chunk_bytes: int | None = None,
    ) -> None:
        self._simulator = Chunked(simulator, chunk_bytes) if chunk_bytes else simulator
        self._clock = clock
        self._sent = b""
        self._connected = True

    def write(self, data: bytes) -> None:
        """Give ``data`` to the instrument.

        Raises
        ------
        LinkError
            When the port is closed or a fault has cut the line.
        """
        self._require_line()
        self._collect(lambda: self._simulator.feed(data))

    def read(self, timeout_s: float) -> bytes:
        """What the instrument has sent, or nothing after ``timeout_s``.

        Raises
        ------
        LinkError
            As `write`, once everything sent before has been read.
        """
        if not self._sent:
            self._require_line()
            self._wait(timeout_s)
        sent, self._sent = self._sent, b""
        return sent

    def press(self) -> None:
        """Press the instrument down; what it sends is there for the next reads."""
        self._require_line()
        self._collect(self._simulator.press)

    def close(self) -> None:
        """Give the port back; the instrument forgets what it still owed."""
        self._connected = False
        self._sent = b""
        self._simulator.disconnect()

    def _wait(self, timeout_s: float) -> None:
        self._collect(self._simulator.poll)
        if self._clock is None:
            return
        end = self._clock() + max(timeout_s, SHORTEST_READ_S)
        while self._connected and not self._sent and self._clock() < end:
            due = self._simulator.due_at()
            self._clock.advance_to(end if due is None else min(due, end))
            self._collect(self._simulator.poll)

    def _collect(self, call: Callable[[], bytes]) -> None:
        try:
            self._sent += call()
        except LineCutError as cut:
            self._sent += cut.sent
            self._connected = False
            self._simulator.disconnect()

    def _require_line(self) -> None:
        if not self._connected:
            msg = "the line to the simulated instrument is closed: open a new port"
            raise LinkError(msg)
