"""`paintlink calibrate`: the white calibration of an instrument."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.operator import Operator
from paintlink.cli.state import config_option, find_instrument, settings_of


@click.command("calibrate", short_help="Calibrate an instrument on its white plaque.")
@click.argument("device")
@click.option("--driver", help="Kind of instrument, when DEVICE is a port.")
@click.option(
    "--done",
    is_flag=True,
    help="Only note that it was calibrated just now with its own keys.",
)
@config_option
def command(device: str, driver: str | None, done: bool, config: Path | None) -> None:
    """Calibrate DEVICE on its white plaque; follow what is printed.

    A running service lends the instrument and takes it back. The time is remembered:
    after 8 hours, or as `calibration_h` says, a calibration is due again.
    """
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.taking import at_hand, clock_of

    settings = settings_of(config)
    instrument = find_instrument(settings, device, driver)
    with (
        at_hand(settings, instrument) as session,
        Journal(settings.journal_path) as journal,
    ):
        if not done:
            session.calibrate(Operator())
        state = session.calibration()
        how = "its own keys" if done else "paintlink calibrate"
        clock_of(journal, instrument, session).calibrated(how)
    click.echo(f"{instrument.name}: calibration {state}, noted")
