"""Answers damaged at random, in every way a line is known to damage them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np

from paintlink_simulators._simulator import Simulator, Wrapper, earlier
from paintlink_simulators._uart import LineSettings, heard

Mutation = Callable[[np.random.Generator, bytes, bytes], bytes]
"""From a source of chance, an answer and the one before to what is sent."""

XON_XOFF = (0x11, 0x13)
NUL_RUN = 200
MOST_FLIPS = 4
INSTRUMENT = LineSettings(9600.0)
RATES = (1200.0, 4800.0, 19200.0, 115200.0)


def _flip(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    damaged = np.frombuffer(answer, np.uint8).copy()
    for _ in range(int(rng.integers(1, MOST_FLIPS + 1))):
        damaged[rng.integers(len(damaged))] ^= np.uint8(1 << rng.integers(8))
    return damaged.tobytes()


def _drop(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    start, stop = _part(rng, answer)
    return answer[:start] + answer[stop:]


def _duplicate(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    start, stop = _part(rng, answer)
    return answer[:stop] + answer[start:]


def _insert(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    place = int(rng.integers(len(answer) + 1))
    junk = rng.integers(256, size=int(rng.integers(1, 9)), dtype=np.uint8).tobytes()
    return answer[:place] + junk + answer[place:]


def _replace(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    place = int(rng.integers(len(answer)))
    other = bytes([(answer[place] + int(rng.integers(1, 256))) % 256])
    return answer[:place] + other + answer[place + 1 :]


def _splice(rng: np.random.Generator, answer: bytes, before: bytes) -> bytes:
    start = int(rng.integers(len(before) + 1))
    return before[:start] + answer[int(rng.integers(len(answer) + 1)) :]


def _truncate(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    return answer[: int(rng.integers(len(answer)))]


def _flow_control(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    place = int(rng.integers(len(answer) + 1))
    return answer[:place] + bytes([rng.choice(XON_XOFF)]) + answer[place:]


def _nul(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    place = int(rng.integers(len(answer) + 1))
    return answer[:place] + bytes(int(rng.integers(1, NUL_RUN))) + answer[place:]


def _wrong_baud(rng: np.random.Generator, answer: bytes, _before: bytes) -> bytes:
    # The beginning is enough: what follows is garbage of the same kind.
    host = LineSettings(float(rng.choice(RATES)))
    return heard(answer[:40], INSTRUMENT, host)


def _stale(_rng: np.random.Generator, answer: bytes, before: bytes) -> bytes:
    return before + answer


MUTATIONS: Mapping[str, Mutation] = MappingProxyType({
    "drop": _drop,
    "duplicate": _duplicate,
    "flip": _flip,
    "flow control": _flow_control,
    "insert": _insert,
    "nul": _nul,
    "replace": _replace,
    "splice": _splice,
    "stale": _stale,
    "truncate": _truncate,
    "wrong baud": _wrong_baud,
})


class Mutating(Wrapper):
    """Answers are damaged at random while ``active``; all bytes stay in order.

    Every fourth answer, damaged or not, arrives in two parts.

    Attributes
    ----------
    count
        How many answers were damaged.
    share
        The share of the answers that are, 0 to 1.
    """

    def __init__(self, inner: Simulator, seed: int) -> None:
        super().__init__(inner)
        self.count = 0
        self.share = 0.0
        self._rng = np.random.default_rng(seed)
        self._names = sorted(MUTATIONS)
        self._before = b""
        self._held = b""

    def due_at(self) -> float | None:
        """At once for the rest of a split answer."""
        held = self.clock() if self._held else None
        return earlier(self.inner.due_at(), held)

    def feed(self, data: bytes) -> bytes:
        """The answer, or in one of fifty cases an echo of the question before it."""
        echo = self.share and self._rng.random() < self.share / 50.0
        return (data if echo else b"") + super().feed(data)

    def disconnect(self) -> None:
        """Forget the rest of a split answer as well."""
        self._held = b""
        super().disconnect()

    def _pass(self, answer: bytes) -> bytes:
        held, self._held = self._held, b""
        if not answer:
            return held
        before, self._before = self._before, answer
        if self.share and self._rng.random() < self.share:
            self.count += 1
            name = self._names[int(self._rng.integers(len(self._names)))]
            answer = MUTATIONS[name](self._rng, answer, before)
        if self.share and self._rng.random() < 0.25:
            place = int(self._rng.integers(len(answer) + 1))
            answer, self._held = answer[:place], answer[place:]
        return held + answer


def _part(rng: np.random.Generator, answer: bytes) -> tuple[int, int]:
    """A run of at least one byte."""
    start = int(rng.integers(len(answer)))
    return start, int(rng.integers(start + 1, min(start + 40, len(answer)) + 1))
