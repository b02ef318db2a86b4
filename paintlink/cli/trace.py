"""`paintlink trace`: one job from the raw bytes to the delivered files."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.output import json_option, print_json, print_table
from paintlink.cli.state import config_option, open_journal


@click.command("trace", short_help="Follow a job from raw bytes to delivered files.")
@click.argument("job")
@json_option
@config_option
def command(job: str, as_json: bool, config: Path | None) -> None:
    """Follow one JOB from the raw bytes of its readings to its delivered files.

    Each step stands with its hash, compared with the one in the journal's history.
    Exit code 6 when anything was changed.
    """
    from paintlink.cli.jobs import find_job
    from paintlink.errors import JournalError

    with open_journal(config) as journal:
        found = find_job(journal, job)
        steps = list(journal.trail.of_job(found.id))
        events = journal.events(found)
    if as_json:
        history = [{"at": one.at, "kind": one.kind, "text": one.text} for one in events]
        print_json({
            "job": found.token,
            "steps": [one._asdict() for one in steps],
            "history": history,
        })
    else:
        rows = [(one.step, one.text, one.fault or "holds") for one in steps]
        print_table(("step", "what", "proof"), rows)
        print_table(
            ("when", "what", ""), [(one.at, one.kind, one.text) for one in events]
        )
    if any(one.fault for one in steps):
        msg = f"job {found.token} was changed after it was recorded"
        raise JournalError(msg)
