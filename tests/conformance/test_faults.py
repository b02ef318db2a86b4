"""Every driver takes the same exam: its own simulator, every fault, every exchange."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable

import pytest

from paintlink.conformance import (
    CHUNKS,
    EXCHANGES,
    Result,
    cases,
    differences,
    examine,
    examine_all,
    failed,
    subjects,
)
from paintlink.conformance.exam import clean_reading, factors
from paintlink.conformance.stands import transports_of
from paintlink_simulators import FAULTS, STATES

SUBJECTS = subjects()
QUESTIONS = [*itertools.product(SUBJECTS, ("", *STATES, *FAULTS))]
SMALL_CHUNKS, ONE_EXCHANGE = CHUNKS[:-1], (2,)
SOME_EXCHANGES = EXCHANGES[::2]
# Past identification, so that the fault meets the reading itself.
ON_WIRES = (2,)
WIRES = [
    (driver, transport)
    for driver, subject in SUBJECTS.items()
    for transport in transports_of(subject)
    if transport != "memory"
]

SLOW = {"tcp", "rfc2217"}

Collect = Callable[[Iterable[Result]], None]


@pytest.mark.parametrize("driver", SUBJECTS)
def test_every_driver_reads_its_simulator(driver: str) -> None:
    reading = clean_reading(SUBJECTS[driver])

    assert factors(reading).any()
    assert len(reading.raw) >= factors(reading).size


@pytest.mark.parametrize(
    ("driver", "fault"),
    QUESTIONS,
    ids=[f"{driver}-{fault or 'sound'}" for driver, fault in QUESTIONS],
)
def test_fault_gives_whole_reading_or_named_error(
    driver: str, fault: str, collect: Collect
) -> None:
    subject = SUBJECTS[driver]
    questions = [
        *cases(subject, exchanges=SOME_EXCHANGES, chunks=CHUNKS[-1:]),
        *cases(subject, exchanges=ONE_EXCHANGE, chunks=SMALL_CHUNKS),
    ]

    results = [examine(subject, case) for case in questions if case.fault == fault]

    collect(results)
    assert len({result.case.chunk for result in results}) == len(CHUNKS)
    assert not failed(results)


@pytest.mark.proof
@pytest.mark.parametrize("driver", SUBJECTS)
def test_every_fault_at_every_answer_in_every_chunk(
    driver: str, collect: Collect
) -> None:
    subject = SUBJECTS[driver]

    results = [
        examine(subject, case)
        for case in cases(subject, exchanges=EXCHANGES, chunks=CHUNKS)
    ]

    collect(results)
    assert len(results) == len(CHUNKS) * (
        1 + len(STATES) + len(FAULTS) * len(EXCHANGES)
    )
    assert not failed(results)


def over_wires(wires: Iterable[tuple[str, str]]) -> list[Result]:
    """Every answer over transports where time is real; asked all at once."""
    return examine_all(
        (SUBJECTS[driver], case)
        for driver, transport in wires
        for case in cases(SUBJECTS[driver], transport, exchanges=ON_WIRES)
    )


def assert_same_as_in_memory(results: list[Result]) -> None:
    assert not failed(results)
    for driver, subject in SUBJECTS.items():
        own = [one for one in results if one.case.driver == driver]
        assert not differences(own, subject)


def test_quick_transports_give_what_memory_gives(collect: Collect) -> None:
    wires = [wire for wire in WIRES if wire[1] not in SLOW]

    results = over_wires(wires)

    collect(results)
    assert len(results) == len(wires) * (1 + len(STATES) + len(FAULTS))
    assert_same_as_in_memory(results)


@pytest.mark.proof
def test_slow_transports_give_what_memory_gives(collect: Collect) -> None:
    wires = [wire for wire in WIRES if wire[1] in SLOW]

    results = over_wires(wires)

    collect(results)
    assert {wire[1] for wire in wires} == SLOW
    assert_same_as_in_memory(results)
