"""A reading under a fault: right, or refused by name, or the driver has failed."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from paintlink.conformance._cases import Case, Result
from paintlink.conformance._subjects import Subject
from paintlink.conformance.exchanges import Exchanges
from paintlink.conformance.stands import TRANSPORTS, Clock, Stand
from paintlink.errors import (
    InstrumentError,
    LinkError,
    LinkTimeoutError,
    ProtocolError,
    ReadingError,
)
from paintlink.instrument import Link
from paintlink.model import FloatArray, Measurement

SEED = 20261122
PRESS_AFTER_S = 0.2
EXCHANGES = range(8)
CHUNKS = (1, 3, 4096)
NAMED = (LinkError, ProtocolError, InstrumentError, ReadingError)
ASKED_ALONE = 3
BUSY = (InstrumentError, LinkTimeoutError, ProtocolError)
ANGLES = np.array([15.0, 25.0, 45.0, 75.0, 110.0])
WORKERS = 24


def cases(
    subject: Subject,
    transport: str = "memory",
    *,
    exchanges: Sequence[int] = (0,),
    chunks: Sequence[int] = (4096,),
) -> Iterator[Case]:
    """Every question about one driver over one transport."""
    faults = [*itertools.product(subject.kit.FAULTS, exchanges)]
    states = [(state, 0) for state in ("", *subject.kit.STATES)]
    for chunk, (fault, exchange) in itertools.product(chunks, states + faults):
        yield Case(subject.id, transport, fault, exchange, chunk)


def examine(subject: Subject, case: Case) -> Result:
    """The answer to one question; never raises what a driver raises."""
    exchanges = Exchanges()
    try:
        reading = _reading(subject, case, exchanges)
    except NAMED as refusal:
        text = f"{type(refusal).__name__}: {refusal}"
        sound = case.fault in subject.kit.HARMLESS - subject.harmful or not case.fault
        return Result(case, "failed" if sound else "refused", text)
    except Exception as crash:  # noqa: BLE001  a crash of the driver is a finding
        return Result(case, "failed", f"{type(crash).__name__}: {crash}")
    return _judged(subject, case, reading, exchanges)


def examine_all(
    questions: Iterable[tuple[Subject, Case]], *, workers: int = WORKERS
) -> list[Result]:
    """The answers, many at once: where time is real they mostly wait.

    What is refused although nothing is wrong, and what differs from the answer in
    memory, is asked again, alone, at most three times: a busy machine pauses longer
    than the silence that ends an answer. No other failure is.
    """
    questions = list(questions)
    with ThreadPoolExecutor(workers) as pool:
        answers = list(pool.map(lambda question: examine(*question), questions))
    return [
        _asked_alone(question, answer)
        for question, answer in zip(questions, answers, strict=True)
    ]


def _asked_alone(question: tuple[Subject, Case], answer: Result) -> Result:
    for _ in range(ASKED_ALONE):
        if not _perhaps_busy(question[0], answer):
            break
        answer = examine(*question)
    return answer


def _perhaps_busy(subject: Subject, answer: Result) -> bool:
    case = answer.case
    if case.transport == "memory":
        return False
    if answer.verdict == "failed":
        return answer.text.split(":")[0] in {error.__name__ for error in BUSY}
    bundled = case.fault in subject.kit.BUNDLED
    return not bundled and answer.verdict != _in_memory(subject, case)


@cache
def _in_memory(subject: Subject, case: Case) -> str:
    """The verdict where time passes only when waited."""
    return examine(subject, replace(case, transport="memory")).verdict


def differences(results: Iterable[Result], subject: Subject) -> list[str]:
    """A line for each result that memory gives otherwise.

    Left out are the faults whose outcome hangs on how bytes happen to be bundled, by
    the kernel or by a server.
    """
    lines = []
    for one in results:
        if one.case.fault in subject.kit.BUNDLED:
            continue
        reference = _in_memory(subject, one.case)
        if reference != one.verdict:
            lines.append(f"{one.case}: {one.verdict}, in memory {reference}")
    return lines


@cache
def clean_reading(subject: Subject) -> Measurement:
    """What the driver reads when nothing goes wrong."""
    return _reading(subject, Case(subject.id), Exchanges())


def build(subject: Subject, case: Case, clock: Clock) -> Any:
    """The simulator of a case: on its panel, with its operator and its fault."""
    kit = subject.kit
    state = kit.STATES.get(case.fault, {})
    simulator = subject.simulator.create(panel(kit), clock=clock, seed=SEED, **state)
    pressed = kit.Operator(simulator, PRESS_AFTER_S)
    fault = kit.FAULTS.get(case.fault)
    return kit.from_answer(case.exchange, fault)(pressed, SEED) if fault else pressed


def panel(kit: Any) -> Any:
    """A red metallic panel; its face reflects more than the perfect diffuser."""
    wavelengths = np.arange(400.0, 701.0, 10.0)
    level = np.array([1.3, 0.9, 0.45, 0.22, 0.15])[:, None]
    shape = 0.3 + 0.7 / (1.0 + np.exp(-(wavelengths - 590.0) / 15.0))
    return kit.Panel(ANGLES, level * shape, "bench panel")


def _reading(subject: Subject, case: Case, exchanges: Exchanges) -> Measurement:
    """One reading as the service takes it: identify, then measure."""
    stand = TRANSPORTS[case.transport]
    with stand(
        subject, lambda clock: build(subject, case, clock), case.chunk
    ) as connected:
        driver = open_driver(subject, connected, exchanges)
        driver.identify()
        reading: Measurement = driver.measure(lambda _: None)
        return reading


def open_driver(subject: Subject, stand: Stand, exchanges: Exchanges) -> Any:
    """The driver at the other end of a stand."""
    link = Link(stand.stream, clock=stand.clock, tap=exchanges.tap)
    return subject.driver.create(link, subject.options)


def _judged(
    subject: Subject, case: Case, reading: Measurement, exchanges: Exchanges
) -> Result:
    clean = clean_reading(subject)
    got, sound = factors(reading), factors(clean)
    if reading.geometries != clean.geometries or got.shape != sound.shape:
        return Result(case, "failed", "the reading is not whole")
    if np.array_equal(got, sound):
        return Result(case, "reading")
    if case.fault in subject.kit.HARMLESS or not case.fault:
        return Result(case, "failed", "another reading under a harmless fault")
    if exchanges.tell(subject, got, sound):
        return Result(case, "as sent", "the bytes on the line say so")
    return Result(case, "failed", "a reading that was never sent")


def factors(reading: Measurement) -> FloatArray:
    """The reflectance factors; none where the reading has Lab values only."""
    if reading.spectra is None:
        return np.empty((0, 0))
    return reading.spectra.factors
