"""Faults in the bytes of an answer; an answer is what one call sends."""

from __future__ import annotations

from collections.abc import Callable

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
