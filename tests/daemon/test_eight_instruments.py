"""Eight instruments at once, beside one that is stalled and one that never stops."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from paintlink.instrument import ByteStream, SerialSettings, UsbSettings
from paintlink.links import open_link
from tests.daemon.instrument_bench import Desk
from tests.daemon.test_instruments import Dumb

READINGS = 10_000
LIMIT_MS = 200.0
GROWTH_MIB = 20.0


class Stopwatch:
    """Time from the last byte of each reading until it was stored, of one instrument.

    Answers to the host's questions are bytes as well: what counts is the last one
    before the reading was stored.
    """

    def __init__(self) -> None:
        self.last_byte_s = 0.0
        self.latencies_ms: list[float] = []
        self.asked = 0

    def open(
        self, address: str, serial: SerialSettings, usb: UsbSettings | None
    ) -> ByteStream:
        inner, watch = open_link(address, serial, usb), self

        class Stream:
            write, close = inner.write, inner.close

            def read(self, timeout_s: float) -> bytes:
                data = inner.read(timeout_s)
                if data:
                    watch.last_byte_s = time.monotonic()
                return data

        return Stream()

    def stored(self) -> None:
        self.latencies_ms.append(1000.0 * (time.monotonic() - self.last_byte_s))

    def is_ready(self, _sentence: str) -> bool:
        self.asked += 1
        return True


class Floor(threading.Thread):
    """How late this machine itself is: a short sleep and an fsync, again and again.

    A busy machine is late whatever the program does, several times for each reading.
    """

    TIMES = 4.0

    def __init__(self, folder: Path) -> None:
        super().__init__(daemon=True)
        self._path = folder / "floor"
        self._stop_event = threading.Event()
        self.late_ms: list[float] = []

    def run(self) -> None:
        with self._path.open("wb", buffering=0) as file:
            while not self._stop_event.is_set():
                start = time.monotonic()
                self._stop_event.wait(0.002)
                file.write(b"x")
                os.fsync(file.fileno())
                self.late_ms.append(1000.0 * (time.monotonic() - start) - 2.0)
                self._stop_event.wait(0.02)

    def stop(self) -> float:
        """The 99th percentile in milliseconds."""
        self._stop_event.set()
        self.join()
        return float(np.percentile(self.late_ms, 99.0))


@pytest.fixture
def paths() -> Iterator[dict[str, str]]:
    server = subprocess.Popen(
        [sys.executable, "-m", "tests.daemon.eight_instruments"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert server.stdout is not None
    yield json.loads(server.stdout.readline())
    server.communicate(timeout=20.0)


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    desk = Desk(tmp_path)
    yield desk
    desk.close()


@pytest.fixture
def troublemakers() -> Iterator[tuple[Dumb, Dumb]]:
    stalled, flooding = Dumb(), Dumb()
    flooding.thread.start()
    yield stalled, flooding
    stalled.close()
    flooding.close()


def resident_mib() -> float:
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024.0
    raise AssertionError("no VmRSS")


@pytest.mark.proof
@pytest.mark.timeout(1800)
def test_eight_instruments_lose_nothing_beside_two_that_misbehave(
    desk: Desk, paths: dict[str, str], troublemakers: tuple[Dumb, Dumb]
) -> None:
    watches = {name: Stopwatch() for name in paths}
    start = time.monotonic()
    workers = [
        desk.work(
            name.split()[0],
            path,
            name=name,
            opener=watches[name].open,
            is_ready=watches[name].is_ready,
            wake_line=watches[name].stored,
            captures=desk.folder / "captures",
        )
        for name, path in paths.items()
    ]
    for number, one in enumerate(troublemakers):
        desk.work("chn_cr30", one.path, name=f"trouble {number}")
    floor = Floor(desk.folder)
    floor.start()
    grown_mib = _memory_while(workers, watches)
    floor_ms = floor.stop()
    seconds = time.monotonic() - start

    taken = Counter(_stored_by(desk))
    slowest = {name: p99(watch) for name, watch in watches.items()}
    print(f"\n{sum(taken.values())} readings in {seconds:.0f} s")  # noqa: T201
    print(f"p99 latency in ms: {slowest}; memory {grown_mib:+.1f} MiB")  # noqa: T201
    print(f"p99 of the machine itself: {floor_ms:.1f} ms")  # noqa: T201
    for name, watch in watches.items():
        assert taken[name] == len(watch.latencies_ms) > 0, name
        if watch.asked:
            # The one being taken when the test ended was asked for and not stored.
            assert watch.asked - taken[name] in {0, 1}, name
    raws = desk.journal._db.all("SELECT raw FROM readings")
    assert len({row["raw"] for row in raws}) == len(raws) >= READINGS
    assert max(slowest.values()) < LIMIT_MS + Floor.TIMES * floor_ms
    assert grown_mib < GROWTH_MIB
    states = {one.name: one.state for one in desk.journal.instruments()}
    assert (states["trouble 0"], states["trouble 1"]) == ("absent", "absent")


def p99(watch: Stopwatch) -> float:
    return round(float(np.percentile(watch.latencies_ms, 99.0)), 1)


def _memory_while(
    workers: list[threading.Thread], watches: dict[str, Stopwatch]
) -> float:
    """Growth of the resident memory from a fifth of the readings to the last one."""
    early_mib = 0.0
    while (count := sum(len(one.latencies_ms) for one in watches.values())) < READINGS:
        assert all(worker.is_alive() for worker in workers)
        workers[0].join(0.2)
        if not early_mib and count > READINGS / 5:
            early_mib = resident_mib()
    return resident_mib() - early_mib


def _stored_by(desk: Desk) -> list[str]:
    desk.stop.set()
    for thread in desk.threads:
        thread.join(20.0)
    return [
        row["source"] for row in desk.journal._db.all("SELECT source FROM readings")
    ]
