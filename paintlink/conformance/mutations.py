"""Thousands of damaged answers: no crash, no hang, nothing invented, in step again."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from paintlink.conformance._subjects import Subject
from paintlink.conformance.exam import NAMED, factors, panel
from paintlink.conformance.exchanges import Exchanges
from paintlink.instrument import Link
from paintlink.model import Measurement

PRESS_AFTER_S = 0.2
# Between two checks that a sound reading follows at once.
PERIOD = 8
SHARES = (0.1, 0.3, 1.0)
LONGEST_S = 400.0
PAUSE_S = 2.0
GOLDEN = (5.0**0.5 - 1.0) / 2.0
LAST_DIGIT = 1e-4
ENOUGH = 20
# Longer than the service waits: time passes by the waits, and nobody cancels.
SLICE_S = 0.2


@dataclass(slots=True)
class Report:
    """What came of a run.

    Parameters
    ----------
    damaged
        Answers that were damaged.
    collisions
        Readings that differ from the panel as the damaged bytes legally say.
    findings
        A line for each crash, hang, invented reading, or reading refused on a line that
        was sound again.
    """

    damaged: int = 0
    readings: int = 0
    refusals: int = 0
    collisions: int = 0
    findings: list[str] = field(default_factory=list)


def mutate(subject: Subject, count: int, seed: int) -> Report:
    """Read the simulator until ``count`` answers have been damaged."""
    bench = _Bench(subject, seed)
    report = Report()
    turn = 0
    while report.damaged < count and len(report.findings) < ENOUGH:
        noisy = turn % PERIOD != PERIOD - 1
        bench.next_panel(SHARES[turn // PERIOD % len(SHARES)] if noisy else 0.0)
        _one(bench, report)
        report.damaged = bench.line.count
        turn += 1
    return report


class _Bench:
    """A driver on a noisy line, a noiseless instrument, a new panel each time."""

    def __init__(self, subject: Subject, seed: int) -> None:
        kit = subject.kit
        self.subject = subject
        self.clock = kit.ManualClock()
        self._panel = panel(kit)
        self._level = float(np.random.default_rng(seed).uniform())
        self._instrument = subject.simulator.create(
            self._panel, clock=self.clock, seed=seed, repeatability=kit.EXACT
        )
        operated = kit.Operator(self._instrument, PRESS_AFTER_S)
        self.line = kit.Mutating(operated, seed)
        self._port = kit.MemoryPort(self.line, self.clock)
        self.exchanges = Exchanges()
        link = Link(
            self._port,
            clock=self.clock,
            tap=lambda direction, data: self.exchanges.tap(direction, data),
            slice_s=SLICE_S,
        )
        self.driver: Any = subject.driver.create(link, subject.options)
        self.driver.identify()

    def next_panel(self, share: float) -> None:
        """Lay another panel under the instrument, on a line with so much noise."""
        self.exchanges = Exchanges()
        self.line.share = share
        self._port.read(PAUSE_S)
        self.clock.advance(PAUSE_S)
        # In steps that come near none of the last hundred: a panel that reads as the
        # one before, to the last digit, would be taken for a reading sent twice.
        self._level = (self._level + GOLDEN) % 1.0
        factors = self._panel.factors * (0.5 + 0.5 * self._level)
        self._instrument.panel = replace(self._panel, factors=factors)

    def is_true(self, reading: Measurement) -> bool:
        """Whether the panel looks as the reading says, to the last digit of a line."""
        angles = [one.aspecular_deg for one in reading.geometries]
        truth = self._instrument.panel.factors_at(angles)
        return bool(np.allclose(factors(reading), truth, rtol=0.0, atol=LAST_DIGIT))


def _one(bench: _Bench, report: Report) -> None:
    """One reading; a sound line must give one."""
    started = bench.clock()
    try:
        reading: Measurement = bench.driver.measure(lambda _: None)
    except NAMED as refusal:
        report.refusals += 1
        if not bench.line.share:
            what = f"{type(refusal).__name__}: {refusal}"
            report.findings.append(f"refused on a sound line: {what}")
    except Exception as crash:  # noqa: BLE001  a crash of the driver is a finding
        report.findings.append(f"{type(crash).__name__}: {crash}")
    else:
        report.readings += 1
        _judge(bench, report, reading)
    if bench.clock() - started > LONGEST_S:
        report.findings.append(f"a reading took {bench.clock() - started:g} s")


def _judge(bench: _Bench, report: Report, reading: Measurement) -> None:
    if bench.is_true(reading):
        return
    written = list(bench.subject.simulator.spectra(bench.exchanges.pairs))
    rows = factors(reading)
    if all(any(np.allclose(row, one, atol=1e-9) for one in written) for row in rows):
        report.collisions += 1
    else:
        report.findings.append("a reading that was never sent")
