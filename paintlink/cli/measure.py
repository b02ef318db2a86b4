"""`paintlink measure`: one reading, from the instrument to the other program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.output import json_option, print_json
from paintlink.cli.state import config_option, find_instrument, settings_of

if TYPE_CHECKING:
    from paintlink.config import Settings
    from paintlink.model import Finish, Reading


@click.command("measure", short_help="Take one reading and send it down the line.")
@click.argument("device")
@click.option("--driver", help="Kind of instrument, when DEVICE is a port.")
@click.option("--sample", help="Name of the sample; instrument and time if left out.")
@click.option("--readings", type=click.IntRange(1, 20), help="Readings to average.")
@click.option(
    "--finish",
    type=click.Choice(["solid", "metallic", "pearl", "unknown"]),
    default="unknown",
    help="Finish of the sample, with --dry-run.",
)
@click.option(
    "--dry-run", is_flag=True, help="Show the answer; store and send nothing."
)
@json_option
@config_option
def command(
    *,
    device: str,
    driver: str | None,
    sample: str | None,
    readings: int | None,
    finish: Finish,
    dry_run: bool,
    as_json: bool,
    config: Path | None,
) -> None:
    """Take one reading with DEVICE and send it down the line.

    DEVICE is the name of a configured instrument, or a port such as /dev/ttyUSB0 or
    socket://host:port together with --driver.
    """
    from paintlink.cli.jobs import job_document, print_job
    from paintlink.daemon.instruments import default_sample
    from paintlink.daemon.oneshot import process
    from paintlink.daemon.session import Session

    settings = settings_of(config)
    instrument = find_instrument(settings, device, driver)
    if readings is not None:
        instrument = replace(instrument, readings=readings)
    captures = None if dry_run else settings.captures_folder
    with Session(instrument, captures=captures) as session:
        name = sample or default_sample(instrument.name)
        reading = session.read(name, prompt)
    if dry_run:
        _show(reading, settings, finish, as_json=as_json)
        return
    job = process(settings, reading, instrument.name)
    if as_json:
        print_json(job_document(job))
    else:
        print_job(job)


def prompt(text: str) -> None:
    """Tell the operator what to do."""
    click.secho(text, fg="cyan", err=True)


def _show(
    reading: Reading, settings: Settings, finish: Finish, *, as_json: bool
) -> None:
    from paintlink.cli.output import match_document, spec_document
    from paintlink.cli.snap import print_matches
    from paintlink.daemon.pipeline import match, specify
    from paintlink.library import bundled

    spec = specify(reading, finish)
    _, matches = match(spec, bundled(), settings.snap)
    if as_json:
        matched = [match_document(one) for one in matches]
        print_json({"specification": spec_document(spec), "matches": matched})
    else:
        print_matches(spec, matches[:5], settings.snap)
