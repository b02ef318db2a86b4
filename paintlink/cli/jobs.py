"""`paintlink jobs`: what the line has done, and doing it again."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import (
    json_option,
    lab_text,
    match_document,
    number_text,
    print_json,
    print_table,
    spec_document,
)
from paintlink.cli.state import config_option, open_journal

if TYPE_CHECKING:
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.orders import Verdict
    from paintlink.daemon.records import Job
    from paintlink.export import LabelKind


@click.group("jobs")
def command() -> None:
    """Look at jobs, retry what failed, send again on request."""


@command.command("list")
@click.option("-n", "--limit", default=20, show_default=True, help="Newest N jobs.")
@json_option
@config_option
def list_jobs(limit: int, as_json: bool, config: Path | None) -> None:
    """List jobs, newest first."""
    with open_journal(config) as journal:
        jobs = journal.jobs(limit=limit)
    if as_json:
        print_json([job_document(job) for job in jobs])
        return
    if not jobs:
        click.echo("No jobs yet. Take a reading, or drop a specification in the inbox.")
        return
    columns = ("job", "sample", "state", "nearest", "total", "delivered", "note")
    print_table(columns, [_row(job) for job in jobs])


@command.command("show")
@click.argument("job")
@json_option
@config_option
def show(job: str, as_json: bool, config: Path | None) -> None:
    """Show one JOB: its Lab values, nearest paints, deliveries and history."""
    with open_journal(config) as journal:
        found = find_job(journal, job)
        events = journal.events(found)
    if as_json:
        history = [{"at": one.at, "kind": one.kind, "text": one.text} for one in events]
        print_json(job_document(found) | {"history": history})
        return
    print_job(found)
    print_table(("when", "what", ""), [(one.at, one.kind, one.text) for one in events])


@command.command("retry")
@click.argument("job")
@config_option
def retry(job: str, config: Path | None) -> None:
    """Put a failed JOB, or its failed deliveries, back to work."""
    with open_journal(config) as journal:
        found = find_job(journal, job)
        journal.retry(found)
    click.echo(f"{found.token}: waiting again; the running service takes it from here")


@command.command("resend")
@click.argument("job")
@click.argument("route")
@config_option
def resend(job: str, route: str, config: Path | None) -> None:
    """Send a JOB to a ROUTE once more, under a new file name."""
    with open_journal(config) as journal:
        found = find_job(journal, job)
        journal.resend(found, route)
    click.echo(f"{found.token}: one more file for {route}")


@command.command("verdict")
@click.argument("job")
@click.argument("verdict", type=click.Choice(["pass", "marginal", "fail"]))
@click.option("--note", default="", help="Why, for the history.")
@config_option
def verdict(job: str, verdict: Verdict, note: str, config: Path | None) -> None:
    """Say what a person thinks of a JOB, beside what the machine says."""
    with open_journal(config) as journal:
        found = find_job(journal, job)
        journal.orders.judge(found.id, "human", verdict, note=note)
        both = journal.orders.verdicts(found.id)
    words = ", ".join(f"{one.judge}: {one.verdict}" for one in both)
    click.echo(f"{found.token}: {words}")


@command.command("orders")
@json_option
@config_option
def orders(as_json: bool, config: Path | None) -> None:
    """List what is still to be measured, the oldest first."""
    with open_journal(config) as journal:
        waiting = journal.orders.waiting()
    if as_json:
        print_json([{"order": one.token, **one.order.document()} for one in waiting])
    elif waiting:
        rows = [
            (
                one.order.sample,
                one.template.name,
                one.order.repair_order,
                one.order.panel,
            )
            for one in waiting
        ]
        print_table(("sample", "template", "repair order", "panel"), rows)
    else:
        click.echo("Nothing is ordered. Orders are files in the folder jobs/.")


@command.command("close")
@click.argument("job")
@click.argument("route")
@config_option
def close(job: str, route: str, config: Path | None) -> None:
    """Give up the waiting or unknown deliveries of a JOB to a ROUTE."""
    from paintlink.errors import ConfigError

    open_states = {"pending", "failed", "unknown"}
    with open_journal(config) as journal:
        found = find_job(journal, job)
        given_up = [
            one
            for one in found.deliveries
            if one.route == route and one.state in open_states
        ]
        for one in given_up:
            journal.deliveries.settle(one, "closed", "by command")
    if not given_up:
        msg = f"job {found.token} has nothing waiting or unknown for {route}"
        raise ConfigError(msg)
    click.echo(f"{found.token}: closed {len(given_up)} for {route}")


@command.command("label")
@click.argument("job")
@click.option(
    "--format",
    "kind",
    default="html",
    show_default=True,
    type=click.Choice(["html", "zpl"]),
    help="A page, or the language of label printers.",
)
@config_option
def print_label(job: str, kind: LabelKind, config: Path | None) -> None:
    """Write the label of a JOB to standard output, with its id as a QR code."""
    from paintlink.daemon.order_worker import label_facts
    from paintlink.export import label

    with open_journal(config) as journal:
        found = find_job(journal, job)
        order = journal.orders.of_job(found.order_id)
    text = ""
    if order is not None:
        template = order.template
        text = template.label_html if kind == "html" else template.label_zpl
    click.echo(label(kind, label_facts(found, order), text), nl=False)


@command.command("verify")
@json_option
@config_option
def verify(as_json: bool, config: Path | None) -> None:
    """Compare everything the journal holds with the hashes of its history.

    Exit code 6 when an entry, a reading, a specification or a delivered file that
    still lies in its folder was changed.
    """
    from paintlink.errors import JournalError

    with open_journal(config) as journal:
        faults = list(journal.trail.faults())
        jobs = sum(journal.counts().values())
    if as_json:
        print_json({"jobs": jobs, "faults": [one._asdict() for one in faults]})
    elif faults:
        rows = [(one.job, one.step, one.text, one.fault) for one in faults]
        print_table(("job", "step", "what", "fault"), rows)
    if faults:
        msg = f"{len(faults)} faults in {jobs} jobs: compare with a backup"
        raise JournalError(msg)
    if not as_json:
        click.echo(f"{jobs} jobs: every entry, value and file is as it was recorded")


def find_job(journal: Journal, token: str) -> Job:
    """The job a user means.

    Raises
    ------
    ConfigError
        When there is none, or more than one.
    """
    from paintlink.errors import ConfigError

    found = journal.job(token)
    if found is None:
        msg = f"no job {token!r}, or more than one begins so: see `paintlink jobs list`"
        raise ConfigError(msg)
    return found


def job_document(job: Job) -> dict[str, Any]:
    """A job as a JSON document."""
    return {
        "job": job.token,
        "state": job.state,
        "source": job.source,
        "origin": job.origin,
        "created_at": job.created_at,
        "error": job.error,
        "specification": spec_document(job.spec) if job.spec else None,
        "matches": [match_document(match) for match in job.matches],
        "deliveries": [
            {
                "route": one.route,
                "copy": one.copy,
                "state": one.state,
                "folder": one.folder,
                "file": one.name,
                "sha256": one.sha256,
                "attempts": one.attempts,
                "error": one.error,
            }
            for one in job.deliveries
        ],
        "preview": job.preview.path if job.preview else None,
    }


def _row(job: Job) -> tuple[str, ...]:
    best = job.matches[0] if job.matches else None
    sent = ", ".join(f"{one.route}: {one.state}" for one in job.deliveries)
    errors = [job.error, *(one.error for one in job.deliveries)]
    return (
        job.token,
        job.spec.name if job.spec else job.source,
        job.state,
        best.code if best else "-",
        number_text(best.total if best else None),
        sent or "-",
        next((text for text in errors if text), ""),
    )


def print_job(job: Job) -> None:
    """Print a job for people."""
    click.echo(f"{job.token}  {job.state}  {job.origin}  from {job.source}")
    if job.error:
        click.secho(job.error, fg="red")
    if job.spec:
        rows = [(f"{s.aspecular_deg:g}", lab_text(s.lab)) for s in job.spec.samples]
        title = f"{job.spec.name}: Lab D65/{job.spec.observer}"
        print_table(("aspecular angle", "L a b"), rows, title=title)
    if job.matches:
        paints = [
            (m.code, m.name, m.finish, f"{m.total:.2f}", m.words) for m in job.matches
        ]
        title = f"nearest by {job.matches[0].formula}, {job.matches[0].library}"
        columns = ("code", "name", "finish", "total", "in words")
        print_table(columns, paints[:5], title=title)
    for one in job.deliveries:
        place = f"{one.folder}/{one.name}" if one.name else one.folder
        click.echo(f"{one.route}: {one.state}  {place}  {one.error}".rstrip())
    if job.preview:
        click.echo(f"picture: {job.preview.path or job.preview.note}")
