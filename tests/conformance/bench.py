"""A driver and its simulator on one bench, with time that passes only when waited."""

from __future__ import annotations

from functools import cache
from types import ModuleType

import numpy as np

from paintlink.instrument import ByteStream, Driver, Link, drivers, modules_in_group
from paintlink.model import Measurement
from paintlink_simulators import ManualClock, MemoryPort, Operator, Panel
from paintlink_simulators.faults import Fault

SEED = 20261122
ANGLES = np.array([15.0, 25.0, 45.0, 75.0, 110.0])
WAVELENGTHS = np.arange(400.0, 701.0, 10.0)


def panel() -> Panel:
    """A red metallic panel; its face reflects more than the perfect diffuser."""
    level = np.array([1.3, 0.9, 0.45, 0.22, 0.15])[:, None]
    shape = 0.3 + 0.7 / (1.0 + np.exp(-(WAVELENGTHS - 590.0) / 15.0))
    return Panel(ANGLES, level * shape, "bench panel")


def simulator_module(driver_id: str) -> ModuleType:
    """The simulator that belongs to a driver, by its file name."""
    return modules_in_group("paintlink.simulators").found[driver_id]


class Bench:
    """A driver that measures a panel on its simulator in memory."""

    def __init__(
        self,
        driver_id: str,
        *,
        fault: Fault | None = None,
        chunk_bytes: int | None = None,
    ) -> None:
        clock = ManualClock()
        simulator = simulator_module(driver_id).create(panel(), clock=clock, seed=SEED)
        pressed = Operator(simulator, 0.2)
        faulty = fault(pressed, SEED) if fault else pressed
        port = MemoryPort(faulty, clock, chunk_bytes=chunk_bytes)
        self.driver = open_driver(driver_id, port, clock)

    def read(self) -> Measurement:
        """One reading, as the service takes it: identify, then measure."""
        self.driver.identify()
        return self.driver.measure(lambda text: None)


def open_driver(driver_id: str, stream: ByteStream, clock: ManualClock) -> Driver:
    """The driver at the other end of a stream."""
    return drivers()[driver_id].create(Link(stream, clock=clock), {})


@cache
def clean_reading(driver_id: str) -> Measurement:
    """What the driver reads when nothing goes wrong."""
    return Bench(driver_id).read()
