"""Damaged answers by the thousand: no crash, no hang, nothing invented."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from paintlink.conformance import Report, mutate, subject, subjects
from paintlink_simulators.faults import MUTATIONS

DRIVERS = sorted(subjects())
SHARE = 500
# 200 000 take a quarter of an hour: PAINTLINK_MUTATIONS=200000 asks for them.
PROOF = int(os.environ.get("PAINTLINK_MUTATIONS", "20000"))
PARTS = 4
# One damaged answer in so many may be another legal one: where nothing but its form
# protects it, and where a sum of bytes does, which misses one change in 256 at best.
RARE = {"chn_cr30": 1000, "km_cm512": 25, "xrite_ma": 25, "xrite_rci": 25}


def part(driver: str, seed: int) -> Report:
    return mutate(subject(driver), PROOF // PARTS, seed)


def assert_sound(report: Report, driver: str) -> None:
    assert not report.findings
    assert report.readings
    assert report.refusals
    assert report.collisions <= report.damaged // RARE.get(driver, 25)


@pytest.mark.parametrize("driver", DRIVERS)
def test_damaged_answers_are_refused_or_right(driver: str) -> None:
    report = mutate(subject(driver), SHARE, seed=11)

    assert report.damaged >= SHARE
    assert_sound(report, driver)


@pytest.mark.proof
@pytest.mark.timeout(3000)
@pytest.mark.parametrize("driver", DRIVERS)
def test_thousands_of_damaged_answers_are_refused_or_right(
    driver: str, record_property: Callable[[str, object], None]
) -> None:
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(os.cpu_count(), context) as pool:
        reports = list(pool.map(part, [driver] * PARTS, range(PARTS)))

    record_property(
        "mutations",
        f"{driver}: {sum(one.damaged for one in reports)} damaged answers, "
        f"{sum(one.readings for one in reports)} readings, "
        f"{sum(one.refusals for one in reports)} refusals, "
        f"{sum(one.collisions for one in reports)} provable collisions",
    )
    assert sum(report.damaged for report in reports) >= PROOF
    for report in reports:
        assert_sound(report, driver)


@pytest.mark.parametrize("name", MUTATIONS)
def test_every_mutation_damages_most_answers(name: str) -> None:
    rng = np.random.default_rng(5)
    answer, before = b"X-RITE MA68II 3.02\r\n", b"CALIBRATION OK\r\n"

    damaged = [MUTATIONS[name](rng, answer, before) for _ in range(100)]

    assert sum(one != answer for one in damaged) > 90


def test_mutations_reach_every_byte_value() -> None:
    rng = np.random.default_rng(6)
    answer = b"CALIBRATION OK\r\n"
    sent = b"".join(MUTATIONS["replace"](rng, answer, b"") for _ in range(20_000))

    assert set(sent) == set(range(256))
