"""`paintlink calibrate`: the white calibration of an instrument."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.measure import prompt
from paintlink.cli.state import config_option, find_instrument, settings_of


@click.command("calibrate")
@click.argument("device")
@click.option("--driver", help="Kind of instrument, when DEVICE is a port.")
@config_option
def command(device: str, driver: str | None, config: Path | None) -> None:
    """Calibrate DEVICE on its white plaque; follow what is printed."""
    from paintlink.daemon.session import Session

    instrument = find_instrument(settings_of(config), device, driver)
    with Session(instrument) as session:
        session.calibrate(prompt)
        state = session.calibration()
    click.echo(f"{instrument.name}: calibration {state}")
