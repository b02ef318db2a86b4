"""Collects every answer of the exam and prints the table at the end of the run.

The answers travel in the tests' reports: tests side by side are other processes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import astuple
from typing import Any

import pytest

from paintlink.conformance import TRANSPORTS, Case, Result, rows


@pytest.fixture
def collect(
    record_property: Callable[[str, object], None],
) -> Callable[[Iterable[Result]], None]:
    def record(results: Iterable[Result]) -> None:
        answers = [(*astuple(one.case), one.verdict) for one in results]
        record_property("conformance", answers)

    return record


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    for line in reported(terminalreporter, "mutations"):
        terminalreporter.write_line(str(line))
    results = [
        Result(Case(*case), verdict)
        for answers in reported(terminalreporter, "conformance")
        for *case, verdict in answers
    ]
    if not results:
        return
    terminalreporter.section("conformance: every driver, every fault, every transport")
    heads = ("driver", "fault", *TRANSPORTS)
    table = [heads, *rows(sorted(results, key=by_driver_and_fault), [*TRANSPORTS])]
    widths = [max(len(row[column]) for row in table) for column in range(len(heads))]
    for row in table:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        terminalreporter.write_line("  ".join(cells).rstrip())
    terminalreporter.write_line(f"{len(results)} readings")


def reported(terminalreporter: pytest.TerminalReporter, wanted: str) -> Iterator[Any]:
    """What the tests that ran have recorded under a name."""
    for outcome in ("passed", "failed"):
        for report in terminalreporter.stats.get(outcome, []):
            for name, value in report.user_properties:
                if name == wanted and report.when == "call":
                    yield value


def by_driver_and_fault(result: Result) -> tuple[str, str]:
    return result.case.driver, result.case.fault
