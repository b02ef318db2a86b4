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
SMALL_CHUNKS, SOME_EXCHANGES = CHUNKS[:-1], (1, 4)
# Past identification, so that the fault meets the reading itself.
ON_WIRES = (2,)
WIRES = [
    (driver, transport)
    for driver, subject in SUBJECTS.items()
    for transport in transports_of(subject)
    if transport != "memory"
]

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
        *cases(subject, exchanges=EXCHANGES, chunks=CHUNKS[-1:]),
        *cases(subject, exchanges=SOME_EXCHANGES, chunks=SMALL_CHUNKS),
    ]

    results = [examine(subject, case) for case in questions if case.fault == fault]

    collect(results)
    assert len({result.case.chunk for result in results}) == len(CHUNKS)
    assert not failed(results)


@pytest.fixture(scope="module")
def over_wires() -> dict[tuple[str, str], list[Result]]:
    """Every answer over a transport where time is real; asked all at once."""
    questions = [
        (SUBJECTS[driver], case)
        for driver, transport in WIRES
        for case in cases(SUBJECTS[driver], transport, exchanges=ON_WIRES)
    ]
    answers: dict[tuple[str, str], list[Result]] = {wire: [] for wire in WIRES}
    for result in examine_all(questions):
        answers[result.case.driver, result.case.transport].append(result)
    return answers


@pytest.mark.parametrize(
    ("driver", "transport"), WIRES, ids=["-".join(wire) for wire in WIRES]
)
def test_every_transport_gives_the_same_or_refuses(
    driver: str,
    transport: str,
    over_wires: dict[tuple[str, str], list[Result]],
    collect: Collect,
) -> None:
    results = over_wires[driver, transport]

    collect(results)
    assert len(results) == 1 + len(STATES) + len(FAULTS)
    assert not failed(results)
    assert not differences(results, SUBJECTS[driver])
