"""`paintlink measure`: one reading, from the instrument to the other program."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.operator import Operator
from paintlink.cli.output import json_option, print_json
from paintlink.cli.state import config_option, find_instrument, settings_of

if TYPE_CHECKING:
    from paintlink.config import InstrumentSettings, Settings
    from paintlink.model import Finish, Reading


@click.command("measure", short_help="Take one reading and send it down the line.")
@click.argument("device")
@click.option("--driver", help="Kind of instrument, when DEVICE is a port.")
@click.option("--sample", help="Name of the sample; instrument and time if left out.")
@click.option("--readings", type=click.IntRange(1, 20), help="Readings to average.")
@click.option(
    "--finish",
    type=click.Choice(["solid", "metallic", "pearl", "unknown"]),
    help="Finish of the sample; an instrument with one angle serves solids only.",
)
@click.option(
    "--stored", is_flag=True, help="Take over the readings the instrument keeps."
)
@click.option(
    "--clear", is_flag=True, help="With --stored: then delete them in the instrument."
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
    finish: Finish | None,
    stored: bool,
    clear: bool,
    dry_run: bool,
    as_json: bool,
    config: Path | None,
) -> None:
    """Take one reading with DEVICE and send it down the line.

    DEVICE is the name of a configured instrument, or a port such as /dev/ttyUSB0,
    socket://host:port or usb://0765:d020 together with --driver. A running service
    lends the instrument and takes it back.

    With --stored nothing is measured: the readings in the instrument's memory are taken
    over, each of them once, however often this is called.
    """
    settings = settings_of(config)
    instrument = find_instrument(settings, device, driver)
    instrument = replace(
        instrument,
        readings=readings or instrument.readings,
        finish=finish or instrument.finish,
    )
    if stored:
        _take_over(settings, instrument, clear=clear, as_json=as_json)
    elif dry_run:
        reading = _look(settings, instrument, sample)
        _show(reading, settings, instrument.finish, as_json=as_json)
    else:
        _measure(settings, instrument, sample, as_json=as_json)


def _measure(
    settings: Settings,
    instrument: InstrumentSettings,
    sample: str | None,
    *,
    as_json: bool,
) -> None:
    from paintlink.cli.jobs import job_document, print_job
    from paintlink.daemon.instruments import default_sample
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.oneshot import process
    from paintlink.daemon.taking import at_hand, clock_of, take

    with (
        at_hand(settings, instrument, captures=settings.captures_folder) as session,
        Journal(settings.journal_path) as journal,
    ):
        clock = clock_of(journal, instrument, session)
        name = sample or default_sample(instrument.name)
        reading = take(session, clock, name, Operator())
    job = process(settings, reading, instrument.name)
    if as_json:
        print_json(job_document(job))
    else:
        print_job(job)


def _look(
    settings: Settings, instrument: InstrumentSettings, sample: str | None
) -> Reading:
    from paintlink.daemon.instruments import default_sample
    from paintlink.daemon.taking import at_hand

    with at_hand(settings, instrument) as session:
        return session.read(sample or default_sample(instrument.name), Operator())


def _take_over(
    settings: Settings, instrument: InstrumentSettings, *, clear: bool, as_json: bool
) -> None:
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.oneshot import work_off
    from paintlink.daemon.taking import at_hand, take_stored

    with Journal(settings.journal_path) as journal:
        captures = settings.captures_folder
        with at_hand(settings, instrument, captures=captures) as session:
            new, known = take_stored(journal, session, instrument.name)
            if clear:
                session.clear()
        work_off(settings, journal)
    if as_json:
        print_json({"new": new, "known": known})
    else:
        click.echo(f"{new} new readings; {known} were here before")


def _show(
    reading: Reading, settings: Settings, finish: Finish, *, as_json: bool
) -> None:
    from paintlink.cli.answers import print_matches
    from paintlink.cli.output import match_document, spec_document
    from paintlink.daemon.paints import known_paints
    from paintlink.daemon.pipeline import match, specify

    spec = specify(reading, finish)
    _, matches = match(spec, known_paints(settings), settings.snap)
    if as_json:
        matched = [match_document(one) for one in matches]
        print_json({"specification": spec_document(spec), "matches": matched})
    else:
        print_matches(spec, matches[:5], settings.snap)
