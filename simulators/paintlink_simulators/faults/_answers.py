"""Faults in the bytes of an answer; an answer is what one call sends."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from paintlink_simulators._simulator import Simulator, Wrapper

Alteration = Callable[[bytes], bytes]


class Altered(Wrapper):
    """Every answer that is not empty goes through ``alter`` first."""

    def __init__(self, inner: Simulator, alter: Alteration) -> None:
        super().__init__(inner)
        self._alter = alter

    def _pass(self, answer: bytes) -> bytes:
        return self._alter(answer) if answer else answer


def swallow(answer: bytes) -> bytes:
    """Nothing: the instrument stays silent."""
    return answer[:0]


def truncate(size: int) -> Alteration:
    """An alteration that leaves the first ``size`` bytes."""
    return lambda answer: answer[:size]


def drop_middle(size: int) -> Alteration:
    """An alteration that loses ``size`` bytes in the middle, never the first byte."""

    def alter(answer: bytes) -> bytes:
        start = max((len(answer) - size) // 2, 1)
        return answer[:start] + answer[start + size :]

    return alter


def duplicate(answer: bytes) -> bytes:
    """The answer twice."""
    return answer + answer


def prefix_garbage(rng: np.random.Generator, size: int) -> Alteration:
    """An alteration that puts ``size`` bytes from 80 to FF in front."""
    return lambda answer: rng.integers(0x80, 0x100, size, np.uint8).tobytes() + answer


def flip_bit(rng: np.random.Generator) -> Alteration:
    """An alteration that inverts one bit, anywhere."""

    def alter(answer: bytes) -> bytes:
        byte, bit = divmod(int(rng.integers(8 * len(answer))), 8)
        flipped = bytes([answer[byte] ^ (1 << bit)])
        return answer[:byte] + flipped + answer[byte + 1 :]

    return alter


def drop_first(answer: bytes) -> bytes:
    """All but the first byte."""
    return answer[1:]


def wrong_last_byte(answer: bytes) -> bytes:
    """The answer with its last byte before the line end one higher."""
    body = answer.rstrip(b"\r\n")
    if not body:
        return answer
    changed = bytes([(body[-1] + 1) % 256])
    return body[:-1] + changed + answer[len(body) :]


def insert(rng: np.random.Generator, inserted: Sequence[int]) -> Alteration:
    """An alteration that puts one of some bytes in, anywhere."""

    def alter(answer: bytes) -> bytes:
        place = int(rng.integers(len(answer) + 1))
        byte = inserted[int(rng.integers(len(inserted)))]
        return answer[:place] + bytes([byte]) + answer[place:]

    return alter


def prefix(data: bytes) -> Alteration:
    """An alteration that puts ``data`` in front."""
    return lambda answer: data + answer


def lose_runs(rng: np.random.Generator, longest: int) -> Alteration:
    """An alteration that loses every second run of 1 to ``longest`` bytes."""

    def alter(answer: bytes) -> bytes:
        kept, lose = b"", False
        while answer:
            size = int(rng.integers(1, longest + 1))
            kept += b"" if lose else answer[:size]
            answer, lose = answer[size:], not lose
        return kept

    return alter


class After(Wrapper):
    """Every answer goes, with the one before it, through ``combine`` first.

    Parameters
    ----------
    combine
        From the answer before, which is empty at first, and the answer to what is sent.
    """

    def __init__(
        self, inner: Simulator, combine: Callable[[bytes, bytes], bytes]
    ) -> None:
        super().__init__(inner)
        self._combine = combine
        self._before = b""

    def _pass(self, answer: bytes) -> bytes:
        if not answer:
            return answer
        before, self._before = self._before, answer
        return self._combine(before, answer)


def splice(before: bytes, answer: bytes) -> bytes:
    """The first half of the answer before and the second half of this one."""
    return before[: len(before) // 2] + answer[len(answer) // 2 :]


def stale_first(before: bytes, answer: bytes) -> bytes:
    """The answer before once more, then this one."""
    return before + answer


class Swapped(Wrapper):
    """Every second answer is held back until the next one has gone out."""

    def __init__(self, inner: Simulator) -> None:
        super().__init__(inner)
        self._held: bytes | None = None

    def disconnect(self) -> None:
        self._held = None
        super().disconnect()

    def _pass(self, answer: bytes) -> bytes:
        if not answer:
            return answer
        if self._held is None:
            self._held = answer
            return b""
        held, self._held = self._held, None
        return answer + held
