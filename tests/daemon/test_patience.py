from __future__ import annotations

import threading
import time

import pytest

from paintlink.daemon.patience import Patience


@pytest.mark.parametrize(
    ("address", "longest_s"),
    [("/dev/ttyUSB0", 30.0), ("socket://host:1", 2.0), ("usb://0765:d020", 2.0)],
)
def test_waits_grow_to_their_limit(address: str, longest_s: float) -> None:
    patience, stop = Patience(address), threading.Event()
    stop.set()
    delays = []
    for _ in range(9):
        delays.append(patience.delay_s)
        patience.wait(stop)

    assert delays[:2] == [0.5, 1.0]
    assert delays[-1] == longest_s


def test_hint_cuts_the_wait_short_and_begins_anew() -> None:
    patience, stop = Patience("/dev/ttyUSB0"), threading.Event()
    patience.delay_s = 30.0
    start = time.monotonic()
    threading.Timer(0.05, patience.wake).start()

    patience.wait(stop)

    assert time.monotonic() - start < 10.0
    assert patience.delay_s == 0.5


def test_stop_ends_the_wait() -> None:
    patience, stop = Patience("/dev/ttyUSB0"), threading.Event()
    patience.delay_s = 30.0
    start = time.monotonic()
    threading.Timer(0.05, stop.set).start()

    patience.wait(stop)

    assert time.monotonic() - start < 10.0
