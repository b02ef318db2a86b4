"""What became of each imported file, for people and for programs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import print_table, spec_document
from paintlink.errors import ExportError, InputError
from paintlink.intake import Import, Item, Options, read_any

if TYPE_CHECKING:
    from paintlink.daemon.journal import Journal
    from paintlink.model import ColorSpec

ROWS_SHOWN = 40


@dataclass(frozen=True, slots=True)
class Outcome:
    """Where one colour went: a job with its nearest paint, or a file."""

    job: str = ""
    file: str = ""
    nearest: str = ""
    total: float | None = None

    def __str__(self) -> str:
        if self.file:
            return self.file
        found = f", nearest {self.nearest} ({self.total:.1f})" if self.nearest else ""
        return f"job {self.job}{found}"


@dataclass(frozen=True, slots=True)
class Report:
    """One file: what it held and where that went, or why it was refused.

    ``outcomes`` has one for each usable colour, in the order of the file.
    """

    path: Path
    found: Import | None = None
    error: str = ""
    outcomes: tuple[Outcome, ...] = ()
    known_as: str = ""

    @property
    def faulty(self) -> bool:
        """Whether the file or a colour in it was refused."""
        return self.found is None or any(one.refused for one in self.found.items)


def report_on(path: Path, format_id: str, options: Options) -> Report:
    """What a file holds; a refusal is part of the report."""
    try:
        moment = datetime.fromtimestamp(path.stat().st_mtime, UTC)
        options = replace(options, received_at=moment)
    except OSError:
        pass  # reading it says why
    try:
        return Report(path, read_any(path, format_id=format_id, options=options))
    except InputError as error:
        return Report(path, error=str(error))


def queue(report: Report, journal: Journal) -> Report:
    """The report with the job of each colour, all stored durably."""
    from paintlink.daemon.imports import store

    found = report.found
    if found is None or not found.specs:
        return report
    known = journal.file_name(found.sha256)
    if known is not None:
        return replace(report, known_as=known)
    tokens = store(journal, found, report.path.name)
    return replace(report, outcomes=tuple(Outcome(job=token) for token in tokens))


def with_nearest(report: Report, journal: Journal) -> Report:
    """The report with the nearest paint of each job that has one."""
    outcomes = tuple(_with_nearest(one, journal) for one in report.outcomes)
    return replace(report, outcomes=outcomes)


def _with_nearest(outcome: Outcome, journal: Journal) -> Outcome:
    job = journal.job(outcome.job)
    if job is None or not job.matches:
        return outcome
    best = job.matches[0]
    return replace(outcome, nearest=best.code, total=best.total)


def write(report: Report, folder: Path) -> Report:
    """The report with the file of each colour, none of which replaces another."""
    if report.found is None:
        return report
    specs = report.found.specs
    files = (_write(spec, folder) for spec in specs)
    return replace(report, outcomes=tuple(Outcome(file=file) for file in files))


def _write(spec: ColorSpec, folder: Path) -> str:
    from paintlink.cli.files import write_new
    from paintlink.export import safe_name
    from paintlink.spec import spec_id, write_spec

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        msg = f"{folder}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error
    path = folder / safe_name(spec.name, suffix="xml", key=spec_id(spec))
    if not path.exists():  # the name holds the hash of the content
        write_new(path, write_spec(spec))
    return str(path)


def document(report: Report) -> dict[str, Any]:
    """The report as a JSON document."""
    found = report.found
    base = {"file": str(report.path), "error": report.error or None}
    if found is None:
        return base
    outcomes = iter(report.outcomes)
    return base | {
        "format": found.format_id,
        "sha256": found.sha256,
        "notes": list(found.notes),
        "known_as": report.known_as or None,
        "colours": [
            {
                "name": one.name,
                "specification": spec_document(one.spec) if one.spec else None,
                "refused": one.refused or None,
            }
            | {
                key: value or None
                for key, value in asdict(
                    next(outcomes, Outcome()) if one.spec else Outcome()
                ).items()
            }
            for one in found.items
        ],
    }


def print_reports(reports: Sequence[Report]) -> None:
    """Print a line for each colour, then what a person should know."""
    rows = [row for report in reports for row in _rows(report)]
    if rows:
        print_table(("file", "colour", "angles", "result"), rows[:ROWS_SHOWN])
    if len(rows) > ROWS_SHOWN:
        click.echo(f"... and {len(rows) - ROWS_SHOWN} more; --json shows all")
    for report in reports:
        for note in report.found.notes if report.found else ():
            click.echo(f"{report.path.name}: {note}", err=True)
        for text in _faults(report):
            click.secho(text, fg="red", err=True)
    refused = sum(report.faulty for report in reports)
    if len(reports) > 1:
        colours = sum(len(one.found.specs) for one in reports if one.found)
        click.echo(f"{len(reports)} files, {colours} colours, {refused} with refusals")


def _rows(report: Report) -> list[tuple[str, str, str, str]]:
    if report.found is None:
        return []
    outcomes = iter(report.outcomes)
    rows = []
    for item in report.found.items:
        if item.spec is None:
            result = "refused"
        elif report.known_as:
            result = f"imported before as {report.known_as}"
        else:
            result = str(next(outcomes, "can be imported"))
        rows.append((report.path.name, item.name, _angles(item), result))
    return rows


def _angles(item: Item) -> str:
    if item.spec is None:
        return "-"
    return "/".join(f"{angle:g}" for angle in item.spec.angles_deg)


def _faults(report: Report) -> list[str]:
    if report.found is None:
        return [report.error]
    return [
        f"{report.path.name}, {one.name!r}: {one.refused}"
        for one in report.found.items
        if one.refused
    ]
