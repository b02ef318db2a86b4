"""Collects every answer of the exam and prints the table at the end of the run."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import pytest

from paintlink.conformance import TRANSPORTS, Result, rows

COLLECTED = pytest.StashKey[list[Result]]()


@pytest.fixture
def collect(request: pytest.FixtureRequest) -> Callable[[Iterable[Result]], None]:
    return request.config.stash.setdefault(COLLECTED, []).extend


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    for report in terminalreporter.stats.get("passed", []):
        for name, line in report.user_properties:
            if name == "mutations" and report.when == "call":
                terminalreporter.write_line(str(line))
    results = config.stash.get(COLLECTED, [])
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


def by_driver_and_fault(result: Result) -> tuple[str, str]:
    return result.case.driver, result.case.fault
