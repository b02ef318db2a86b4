"""Unplugged at every byte: the half frame is gone, the next reading is whole."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import LinkError
from paintlink.instrument import (
    ByteStream,
    Link,
    SerialSettings,
    UsbSettings,
    drivers,
)
from paintlink.links import open_link
from paintlink.model import Measurement
from paintlink_simulators import ManualClock, MemoryPort, Operator
from tests.daemon.instrument_bench import Desk, panel, simulator_module

ALL = sorted(drivers())
LF = 1
"""What may be missing of a whole reading: a line ends with its CR already."""


class CutStream:
    """A stream that is unplugged once it has given so many bytes."""

    def __init__(self, port: MemoryPort, left: int) -> None:
        self._port = port
        self._pending = b""
        self.left = left
        self.given = 0

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def read(self, timeout_s: float) -> bytes:
        self._pending = self._pending or self._port.read(timeout_s)
        data = self._pending[: self.left]
        if self._pending and not data:
            msg = "unplugged"
            raise LinkError(msg)
        self._pending = self._pending[len(data) :]
        self.left -= len(data)
        self.given += len(data)
        return data

    def close(self) -> None:
        self._port.close()


class Rig:
    """One simulated instrument that is plugged in again and again."""

    def __init__(self, driver_id: str) -> None:
        self.driver_id = driver_id
        self.clock = ManualClock()
        self.seed = 0
        self.renew()

    def renew(self) -> None:
        """Another instrument of the kind: an old one's memory may be full."""
        self.seed += 1
        module = simulator_module(self.driver_id)
        self.simulator = module.create(panel(), clock=self.clock, seed=self.seed)

    def sizes(self) -> tuple[int, int]:
        """Bytes that identification takes, and that a whole reading takes with it."""
        stream = CutStream(MemoryPort(self.simulator, self.clock), 1 << 30)
        driver = drivers()[self.driver_id].create(Link(stream, clock=self.clock), {})
        driver.identify()
        stream.close()
        return stream.given, self.read()[1]

    def read(self, cut_after: int = 1 << 30) -> tuple[Measurement, int]:
        """A reading on a fresh connection, and how many bytes it took."""
        port = MemoryPort(Operator(self.simulator, 0.2), self.clock)
        stream = CutStream(port, cut_after)
        try:
            link = Link(stream, clock=self.clock)
            driver = drivers()[self.driver_id].create(link, {})
            driver.identify()
            return driver.measure(lambda _sentence: None), stream.given
        finally:
            stream.close()


def values(reading: Measurement) -> bytes:
    assert reading.spectra is not None
    return reading.spectra.factors.tobytes()


@pytest.mark.proof
@pytest.mark.timeout(600)
@pytest.mark.parametrize("driver_id", ALL)
def test_cut_at_every_byte_gives_no_half_reading_and_no_double(driver_id: str) -> None:
    rig = Rig(driver_id)
    whole, size = rig.read()
    # A DTP20 says more the first time, while it has no reading in its memory.
    second, later = rig.read()
    seen = {values(whole), values(second)}

    for place in range(size):
        try:
            cut, _ = rig.read(cut_after=place)
        except LinkError:
            pass
        else:
            assert place >= min(size, later) - LF
            assert values(cut) not in seen
            seen.add(values(cut))
        if place % 40 == 0:
            rig.renew()
        after, _ = rig.read()
        assert after.geometries == whole.geometries
        assert values(after) not in seen, f"cut at {place}"
        seen.add(values(after))

    assert len(seen) > size


class Cutter:
    """Opens real ports; the stream in use can be told to end after so many bytes."""

    def __init__(self, unplug: Callable[[], None]) -> None:
        self._unplug = unplug
        self._left: int | None = None
        self.cut = threading.Event()

    def arm(self, place: int) -> None:
        self.cut.clear()
        self._left = place

    def open(
        self, address: str, serial: SerialSettings, usb: UsbSettings | None
    ) -> ByteStream:
        inner = open_link(address, serial, usb)
        cutter = self

        class Stream:
            write, close = inner.write, inner.close

            def read(self, timeout_s: float) -> bytes:
                return cutter.passed(inner.read(timeout_s))

        return Stream()

    def passed(self, data: bytes) -> bytes:
        if self._left is None:
            return data
        kept = data[: self._left]
        self._left -= len(kept)
        if len(kept) < len(data) or not self._left:
            self._left = None
            self._unplug()
            self.cut.set()
        return kept


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    desk = Desk(tmp_path)
    yield desk
    desk.close()


@pytest.mark.proof
@pytest.mark.timeout(600)
@pytest.mark.parametrize("another_name", [False, True], ids=["same", "another"])
@pytest.mark.parametrize("driver_id", ALL)
def test_cut_line_has_its_next_reading_within_three_seconds(
    desk: Desk, driver_id: str, another_name: bool
) -> None:
    """Over pseudo-terminals, at places spread over every answer of a reading."""
    identified, size = Rig(driver_id).sizes()
    places = np.linspace(1, size - identified - 1, 10).astype(int).tolist()
    port = desk.plug(driver_id, "ttyUSB0", press_s=0.02, speed=20.0)
    cutter = Cutter(port.unplug)
    pattern = str(desk.folder / ("ttyUSB*" if another_name else "ttyUSB0"))
    desk.work(driver_id, pattern, is_ready=lambda _text: True, opener=cutter.open)
    desk.until(lambda: desk.count() > 0, "the first reading")

    taken_s = []
    for number, place in enumerate(places):
        cutter.arm(place)
        assert cutter.cut.wait(30.0), desk.statuses()
        desk.until_state("lost")
        if another_name:
            port._link = desk.folder / f"ttyUSB{1 + number % 2}"
        before = desk.count()
        port.replug()
        taken_s.append(desk.until(lambda n=before: desk.count() > n, f"cut {place}"))

    raws = [one.measurement.raw for one in desk.readings()]
    assert len(raws) == len(set(raws))
    print(f"{driver_id}: replugged to stored, slowest {max(taken_s):.2f} s")  # noqa: T201
    assert max(taken_s) <= 3.0
