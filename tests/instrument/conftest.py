from collections.abc import Callable
from types import EllipsisType

import pytest

from paintlink.instrument import Link


class ScriptedStream:
    """Gives each delivery to one read; a number is that many seconds of silence.

    An ellipsis is silence until something is sent. The clock moves in silence only.
    """

    def __init__(self, *script: bytes | float | EllipsisType) -> None:
        self.script = list(script)
        self.sent: list[bytes] = []
        self.now_s = 0.0
        self.longest_wait_s = 0.0

    def clock(self) -> float:
        return self.now_s

    def write(self, data: bytes) -> None:
        self.sent.append(data)
        if ... in self.script:
            del self.script[: self.script.index(...) + 1]

    def read(self, timeout_s: float) -> bytes:
        if self.script and isinstance(self.script[0], bytes):
            return self.script.pop(0)
        wait_s = timeout_s
        if self.script and self.script[0] is not ...:
            wait_s = min(timeout_s, self.script[0])
            self.script[0] -= wait_s
            if self.script[0] < 1e-9:
                self.script.pop(0)
        self.now_s += wait_s
        self.longest_wait_s = max(self.longest_wait_s, wait_s)
        return b""

    def close(self) -> None:
        pass


@pytest.fixture
def scripted() -> Callable[..., tuple[Link, ScriptedStream]]:
    """Return a link over a stream that follows a script, and the stream."""

    def build(*script, **options) -> tuple[Link, ScriptedStream]:
        stream = ScriptedStream(*script)
        return Link(stream, clock=stream.clock, **options), stream

    return build
