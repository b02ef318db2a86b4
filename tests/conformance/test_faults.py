"""Every driver takes the same exam: its own simulator, every fault, every exchange."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from paintlink.errors import InstrumentError, LinkError, ProtocolError, ReadingError
from paintlink.instrument import drivers
from paintlink.model import Measurement
from paintlink_simulators.faults import FAULTS, from_answer
from tests.conformance.bench import Bench, clean_reading

HARMLESS = {"echo_on", "late", "one_byte_at_a_time", "seven_bytes_at_a_time"}
WITHOUT_CHECKSUM = {"flip_bit"}
EXCHANGES = range(8)
NAMED = (LinkError, ProtocolError, InstrumentError, ReadingError)

CASES = list(itertools.product(sorted(drivers()), sorted(FAULTS), EXCHANGES))


def test_every_driver_has_a_simulator() -> None:
    for driver_id in drivers():
        assert Bench(driver_id).read().spectra is not None


def test_every_harmless_fault_is_known() -> None:
    assert set(FAULTS) >= HARMLESS | WITHOUT_CHECKSUM


@pytest.mark.parametrize(
    ("driver_id", "fault", "exchange"),
    CASES,
    ids=["-".join(map(str, case)) for case in CASES],
)
def test_fault_gives_whole_reading_or_named_error(
    driver_id: str, fault: str, exchange: int
) -> None:
    bench = Bench(driver_id, fault=from_answer(exchange, FAULTS[fault]))

    reading = read_or_none(bench, may_fail=fault not in HARMLESS)

    if reading is None:
        return
    assert_whole(reading, clean_reading(driver_id))
    if fault not in WITHOUT_CHECKSUM:
        np.testing.assert_array_equal(
            factors(reading), factors(clean_reading(driver_id))
        )


@pytest.mark.parametrize("chunk", [1, 2, 3, 16, 64, 4096])
@pytest.mark.parametrize("driver_id", sorted(drivers()))
def test_reading_does_not_depend_on_delivery(driver_id: str, chunk: int) -> None:
    reading = Bench(driver_id, chunk_bytes=chunk).read()

    np.testing.assert_array_equal(factors(reading), factors(clean_reading(driver_id)))


def read_or_none(bench: Bench, *, may_fail: bool) -> Measurement | None:
    """The reading; None where the driver refused it by name and may do so."""
    try:
        return bench.read()
    except NAMED:
        if may_fail:
            return None
        raise


def factors(reading: Measurement) -> np.ndarray:
    assert reading.spectra is not None
    return reading.spectra.factors


def assert_whole(reading: Measurement, clean: Measurement) -> None:
    """No partial spectrum, and the angles the model advertises."""
    assert reading.geometries == clean.geometries
    assert factors(reading).shape == factors(clean).shape
    assert len(reading.raw) >= factors(reading).size
