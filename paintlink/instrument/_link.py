"""The link a driver talks through: frames, deadlines, cancellation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, Protocol

from paintlink.errors import CancelledError, LinkTimeoutError, ProtocolError
from paintlink.instrument._framing import line_size
from paintlink.instrument._text import quoted

Direction = Literal["sent", "received", "silence"]
Tap = Callable[[Direction, bytes], None]

BUFFER_LIMIT = 65536
LINE_IDLE_S = 0.2
SLICE_S = 0.05
_ROUNDING_S = 1e-6


class ByteStream(Protocol):
    """Bytes to and from an instrument; failures are ``LinkError``."""

    def write(self, data: bytes) -> None:
        """Send all of ``data``."""

    def read(self, timeout_s: float) -> bytes:
        """Return what is there, at least one byte; nothing after ``timeout_s``."""
        ...

    def close(self) -> None:
        """Give the port back; never fails."""


class Link:
    """One instrument's byte stream, cut into frames.

    Parameters
    ----------
    stream
        Where the bytes come from and go to.
    clock
        Seconds that only grow.
    tap
        Told of every run of bytes and of every wait that ended in silence; with these
        three a session can be replayed.
    cancelled
        Asked at least every 0.1 s while waiting; true ends the wait.
    slice_s
        The longest single wait: bounds how late a cancellation and a silence are
        noticed.
    """

    def __init__(
        self,
        stream: ByteStream,
        *,
        clock: Callable[[], float],
        tap: Tap = lambda _direction, _data: None,
        cancelled: Callable[[], bool] = lambda: False,
        slice_s: float = SLICE_S,
    ) -> None:
        self._stream = stream
        self._clock = clock
        self._tap = tap
        self._cancelled = cancelled
        self._slice_s = slice_s
        self._buffer = bytearray()

    def send(self, data: bytes) -> None:
        """Send ``data``; what was received before stays in the buffer."""
        self._stream.write(data)
        self._tap("sent", data)

    def request(
        self,
        question: bytes,
        decode: Callable[[bytes], int],
        timeout_s: float,
        *,
        idle_s: float | None = None,
    ) -> bytes:
        """Return the frame that answers ``question``; see `receive`.

        What came before is dropped: it cannot be the answer.
        """
        self.discard()
        self.send(question)
        return self.receive(decode, timeout_s, idle_s=idle_s)

    def receive(
        self,
        decode: Callable[[bytes], int],
        timeout_s: float,
        *,
        idle_s: float | None = None,
    ) -> bytes:
        """Return the next frame; bytes after it wait for the next call.

        Parameters
        ----------
        decode
            Given everything received so far, returns the size of the first frame, 0
            when more is needed.
        timeout_s
            Time for the whole frame.
        idle_s
            Silence of this length counts as a line end: ``decode`` is asked once more
            with an LF behind the bytes.

        Raises
        ------
        LinkTimeoutError
            With the incomplete frame, which is dropped.
        """
        heard = self._clock()
        end = heard + timeout_s
        late = False
        while not (size := decode(bytes(self._buffer))):
            if late:
                raise self._timed_out(timeout_s)
            arrived = self._pull(end - self._clock())
            late = self._reached(end)
            if arrived:
                heard = self._clock()
            elif idle_s is not None and self._buffer and self._reached(heard + idle_s):
                size = decode(bytes(self._buffer) + b"\n")
                if size:
                    self._tap("silence", b"")
                    break
        return self._take(size)

    def read_line(self, timeout_s: float) -> str:
        """Return the next line that is not blank, without its end.

        A line ends in CR, LF, CR LF or 200 ms of silence. Bytes become characters one
        by one (Latin-1), so that nothing is lost.
        """
        line = self.receive(line_size, timeout_s, idle_s=LINE_IDLE_S)
        return line.lstrip().rstrip(b"\r\n").decode("latin-1")

    def wait_for_data(self, timeout_s: float, *, after: bytes = b"") -> None:
        """Return once something new is in the buffer, and leave it there.

        Parameters
        ----------
        after
            The last answer: when it comes once more it is nothing new, and neither are
            line ends and blanks.
        """
        end = self._clock() + timeout_s
        while after.startswith(bytes(self._buffer).replace(after, b"").strip()):
            if not self._pull(end - self._clock()) and self._reached(end):
                raise self._timed_out(timeout_s)

    def drain(self, idle_s: float, limit_s: float) -> bytes:
        """Return everything that arrives until ``idle_s`` of silence.

        Raises
        ------
        ProtocolError
            When the instrument still sends after ``limit_s``.
        """
        heard = self._clock()
        end = heard + limit_s
        while True:
            if self._pull(idle_s):
                heard = self._clock()
            elif self._reached(heard + idle_s):
                self._tap("silence", b"")
                return self._take()
            if self._reached(end):
                msg = (
                    f"the instrument is still sending after {limit_s:g} s: "
                    "check the baud rate"
                )
                raise ProtocolError(msg, raw=self._take())

    def watch(self, time_s: float) -> None:
        """Keep the line under watch; what arrives waits in the buffer.

        Raises
        ------
        LinkError
            When the instrument goes away meanwhile.
        """
        end = self._clock() + time_s
        while not self._reached(end):
            self._pull(end - self._clock())

    def discard(self) -> None:
        """Drop what was received and not asked for."""
        self.drain(idle_s=0.0, limit_s=1.0)

    def _reached(self, time_s: float) -> bool:
        # A clock that moves by what is waited never gets over its own rounding.
        return self._clock() >= time_s - _ROUNDING_S

    def _pull(self, timeout_s: float) -> bool:
        if self._cancelled():
            msg = "stopped while waiting for the instrument"
            raise CancelledError(msg)
        data = self._stream.read(min(max(timeout_s, 0.0), self._slice_s))
        if data:
            self._tap("received", data)
            self._buffer += data
        if len(self._buffer) > BUFFER_LIMIT:
            msg = (
                f"the instrument sent more than {BUFFER_LIMIT} bytes without an end: "
                "check the baud rate"
            )
            raise ProtocolError(msg, raw=self._take())
        return bool(data)

    def _take(self, size: int | None = None) -> bytes:
        frame = bytes(self._buffer[:size])
        del self._buffer[:size]
        return frame

    def _timed_out(self, timeout_s: float) -> LinkTimeoutError:
        self._tap("silence", b"")
        partial = self._take()
        got = f"only {quoted(partial)}" if partial.strip() else "nothing"
        msg = (
            f"the instrument sent {got} within {timeout_s:g} s: check that it is "
            "switched on, the cable and the baud rate"
        )
        return LinkTimeoutError(msg, partial=partial)
