"""`paintlink restore`: a copy of the journal put back."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.state import config_option, settings_of


@click.command("restore", short_help="Put a copy of the journal back.")
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False, exists=True))
@config_option
def command(file: Path, config: Path | None) -> None:
    """Put the journal in FILE in place of the present one, which is kept aside.

    Stop the service first. Deliveries that were not settled when the copy was taken
    may have gone out since: they become `unknown`, and nothing is sent twice.
    """
    from paintlink.daemon.backup import restore

    aside = restore(file, settings_of(config).journal_path)
    kept = f"; the one before is kept in {aside}" if aside else ""
    click.echo(f"restored {file}{kept}")
    click.echo("Deliveries to look at: paintlink jobs list")
