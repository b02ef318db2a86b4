"""A metallic panel, an instrument on it, and a client of its terminals."""

from __future__ import annotations

import os
import select
from collections.abc import Callable, Iterator

import pytest

from paintlink_simulators import ManualClock, Panel, panel_from_lab, xrite_ma

PATIENCE_S = 10.0


class Terminal:
    """One open terminal device; nothing waits longer than `PATIENCE_S`."""

    def __init__(self, path: str) -> None:
        self.descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY)
        self._open = True

    def write(self, data: bytes) -> None:
        os.write(self.descriptor, data)

    def read(self) -> bytes:
        ready, _, _ = select.select([self.descriptor], [], [], PATIENCE_S)
        assert ready, "the simulator stayed silent"
        return os.read(self.descriptor, 65536)

    def read_until(self, end: bytes) -> bytes:
        received = b""
        while not received.endswith(end):
            received += self.read()
        return received

    def read_lines(self, count: int) -> list[bytes]:
        received = b""
        while received.count(b"\n") < count:
            received += self.read()
        return received.splitlines()

    def close(self) -> None:
        if self._open:
            os.close(self.descriptor)
        self._open = False


@pytest.fixture
def terminal() -> Iterator[Callable[[str], Terminal]]:
    opened: list[Terminal] = []

    def open_terminal(path: str) -> Terminal:
        opened.append(Terminal(path))
        return opened[-1]

    yield open_terminal
    for one in opened:
        one.close()


@pytest.fixture
def clock() -> ManualClock:
    return ManualClock()


@pytest.fixture(scope="session")
def panel() -> Panel:
    return panel_from_lab(
        (15, 25, 45, 75, 110),
        [(120, -6, -30), (90, -4, -28), (50, 0, -22), (22, 3, -15), (14, 4, -12)],
        "test blue",
    )


@pytest.fixture
def simulator(panel: Panel, clock: ManualClock) -> xrite_ma.XriteMa:
    return xrite_ma.create(panel, clock=clock, seed=7)
