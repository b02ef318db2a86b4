"""`paintlink backup`: a copy of the journal, while the service runs."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.state import config_option, open_journal


@click.command("backup", short_help="Copy the journal while the service runs.")
@click.argument("file", type=click.Path(path_type=Path, dir_okay=False))
@config_option
def command(file: Path, config: Path | None) -> None:
    """Write a whole, checked copy of the journal to FILE, which must not exist."""
    from paintlink.daemon.backup import back_up

    with open_journal(config) as journal:
        back_up(journal, file)
    click.echo(f"{file}: a whole copy; put it back with `paintlink restore {file}`")
