"""The answers as a table: one line a driver and fault, one column a transport."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from paintlink.conformance._cases import Result

ORDER = ("failed", "reading", "as sent", "refused")


def rows(results: Iterable[Result], transports: Sequence[str]) -> list[tuple[str, ...]]:
    """Cells of the table; each says how often which verdict was given."""
    cells: dict[tuple[str, str], dict[str, Counter[str]]] = {}
    for one in results:
        row = cells.setdefault((one.case.driver, one.case.fault or "(none)"), {})
        row.setdefault(one.case.transport, Counter())[one.verdict] += 1
    return [
        (*key, *(_cell(row.get(transport)) for transport in transports))
        for key, row in cells.items()
    ]


def failed(results: Iterable[Result]) -> list[str]:
    """A line for each answer that is wrong."""
    return [f"{one.case}: {one.text}" for one in results if one.verdict == "failed"]


def _cell(counts: Counter[str] | None) -> str:
    if not counts:
        return "-"
    given = [verdict for verdict in ORDER if counts[verdict]]
    if len(given) == 1:
        return _loud(given[0])
    return ", ".join(f"{counts[verdict]} {_loud(verdict)}" for verdict in given)


def _loud(verdict: str) -> str:
    return verdict.upper() if verdict == "failed" else verdict
