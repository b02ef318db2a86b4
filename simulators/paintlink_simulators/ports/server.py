"""A thread that serves one simulator on whatever line is plugged in."""

from __future__ import annotations

import contextlib
import select
import socket
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from queue import SimpleQueue
from types import TracebackType
from typing import Self

from paintlink.errors import LinkError
from paintlink_simulators._simulator import LineCutError, Simulator
from paintlink_simulators._uart import LineSettings, heard
from paintlink_simulators.ports._line import Line, Listener
from paintlink_simulators.ports._pacer import Pacer
from paintlink_simulators.ports.operator import Operator

TICK_S = 0.005
PATIENCE_S = 5.0


class Server:
    """Serves a simulator in a thread of its own, on one line at a time.

    Only that thread touches the simulator, so that every method may be called from
    any thread.

    Parameters
    ----------
    baud
        Pace of the answers, for 10 bits a character; unlimited when left out.
    auto_press_after_s
        Adds an operator who presses the instrument so long after it begins to wait.
    line
        How the instrument's end of the line is set: a client set otherwise, where that
        can be seen, gets garbage and is heard as garbage. None hears everything.
    """

    def __init__(
        self,
        simulator: Simulator,
        *,
        listener: Listener | None = None,
        baud: int | None = None,
        auto_press_after_s: float | None = None,
        line: LineSettings | None = None,
    ) -> None:
        if auto_press_after_s is not None:
            simulator = Operator(simulator, auto_press_after_s)
        self._simulator = simulator
        self._listener = listener
        self._settings = line
        self._line: Line | None = None
        self._outgoing = b""
        self._cut = False
        self._pacer = Pacer(baud)
        self._calls: SimpleQueue[tuple[Callable[[], None], Future[None]]]
        self._calls = SimpleQueue()
        self._waker, self._wakened = socket.socketpair()
        self._stopped = False
        self._closed = False
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def press(self) -> None:
        """Press the instrument down; what it prints goes out on the line."""
        self._call(lambda: self._answer(self._simulator.press))

    def close(self) -> None:
        """End the thread and close the line; the port cannot be used again."""
        with contextlib.suppress(LinkError):
            self._call(self._stop)
        self._thread.join(PATIENCE_S)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _plug(self, line: Line) -> None:
        self._call(lambda: self._attach(line))

    def _unplug(self) -> None:
        self._call(self._hang_up)

    def _call(self, action: Callable[[], None]) -> None:
        """Return when the thread has done ``action``; its error is raised here."""
        done: Future[None] = Future()
        with self._lock:
            if self._closed:
                raise _closed_port()
            self._calls.put((action, done))
            self._waker.send(b"\0")
        done.result(PATIENCE_S)

    def _run(self) -> None:
        try:
            while not self._stopped:
                self._serve(self._wait())
        finally:
            self._leave()

    def _leave(self) -> None:
        with self._lock:
            self._closed = True
        while not self._calls.empty():
            self._calls.get()[1].set_exception(_closed_port())
        self._hang_up()
        for end in (self._listener, self._waker, self._wakened):
            if end is not None:
                end.close()

    def _wait(self) -> set[int]:
        """The descriptors that can be read, as soon as there is something to do."""
        paced = bool(self._outgoing) and self._allowance() == 0
        poll = select.poll()
        poll.register(self._wakened, select.POLLIN)
        if self._listener is not None:
            poll.register(self._listener, select.POLLIN)
        if self._line is not None:
            sendable = select.POLLOUT if self._outgoing and not paced else 0
            poll.register(self._line, select.POLLIN | sendable)
        ready = poll.poll(self._timeout_ms(paced))
        return {fd for fd, events in ready if events & ~select.POLLOUT}

    def _timeout_ms(self, paced: bool) -> float | None:
        waits_s = [TICK_S] if paced else []
        due = self._simulator.due_at()
        if due is not None:
            # The simulator's clock may run faster than the real one.
            waits_s.append(min(max(due - self._simulator.clock(), 0.0), TICK_S))
        return 1000.0 * min(waits_s) if waits_s else None

    def _allowance(self) -> int:
        return self._pacer.allowance(time.monotonic())

    def _serve(self, ready: set[int]) -> None:
        # One source at a time: the first may replace the line the others belong to.
        if self._wakened.fileno() in ready:
            self._run_calls()
        elif self._line is not None and self._line.fileno() in ready:
            self._receive(self._line)
        elif self._listener is not None and self._listener.fileno() in ready:
            self._accept(self._listener)
        self._answer(self._simulator.poll)
        if self._line is not None:
            self._flush(self._line)

    def _run_calls(self) -> None:
        self._wakened.recv(4096)
        while not (self._stopped or self._calls.empty()):
            action, done = self._calls.get()
            try:
                action()
            except Exception as error:  # noqa: BLE001  raised in the calling thread
                done.set_exception(error)
            else:
                done.set_result(None)

    def _receive(self, line: Line) -> None:
        try:
            data = line.receive()
        except BlockingIOError:
            # The client has flushed what it had sent.
            return
        except OSError:
            data = b""
        if data:
            arrived = self._over_the_line(data, inward=True)
            self._answer(lambda: self._simulator.feed(arrived))
        else:
            self._hang_up()

    def _over_the_line(self, data: bytes, *, inward: bool) -> bytes:
        """What one end hears of the other."""
        host = self._line.host_line() if self._line and self._settings else None
        if host is None or self._settings is None:
            return data
        ends = (host, self._settings) if inward else (self._settings, host)
        return heard(data, *ends)

    def _accept(self, listener: Listener) -> None:
        try:
            line = listener.accept()
        except OSError:
            # The client has left before it was greeted.
            return
        if self._line is None:
            self._attach(line)
        else:
            line.close()

    def _answer(self, call: Callable[[], bytes]) -> None:
        try:
            sent = call()
        except LineCutError as cut:
            sent = cut.sent
            self._cut = True
        if self._line is not None:
            if not self._outgoing:
                self._pacer.start(time.monotonic())
            self._outgoing += self._over_the_line(sent, inward=False)

    def _flush(self, line: Line) -> None:
        characters = self._outgoing[: self._allowance()]
        try:
            sent = line.send(characters) if characters else 0
        except BlockingIOError:
            return
        except OSError:
            self._hang_up()
            return
        self._pacer.sent(sent)
        self._outgoing = self._outgoing[sent:]
        if self._cut and not self._outgoing:
            self._hang_up()

    def _attach(self, line: Line) -> None:
        self._hang_up()
        self._line = line

    def _hang_up(self) -> None:
        if self._line is not None:
            self._line.close()
        self._line = None
        self._outgoing = b""
        self._cut = False
        self._simulator.disconnect()

    def _stop(self) -> None:
        self._stopped = True


def _closed_port() -> LinkError:
    return LinkError("the simulator's port is closed: open a new one")
