"""`paintlink health`: whether every route moves."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.output import json_option, number_text, print_json, print_table
from paintlink.cli.state import config_option, settings_of


@click.command("health", short_help="Show whether every route moves.")
@json_option
@config_option
def command(as_json: bool, config: Path | None) -> None:
    """Show what waits for each route, and since when.

    Exit code 5 when a route is red: its folder refuses files, or nothing gets through.
    """
    from paintlink.daemon.database import utc_now
    from paintlink.daemon.health import health
    from paintlink.daemon.journal import Journal
    from paintlink.errors import ExportError

    settings = settings_of(config)
    with Journal(settings.journal_path) as journal:
        routes = health(journal, settings.routes, utc_now())
    if as_json:
        print_json([one._asdict() for one in routes])
    elif routes:
        rows = [
            (
                one.route,
                one.light,
                str(one.waiting),
                number_text(one.oldest_s),
                one.note,
            )
            for one in routes
        ]
        print_table(("route", "light", "waiting", "oldest, s", "note"), rows)
    else:
        click.echo("No route is configured: see `paintlink config explain`.")
    red = [one.route for one in routes if one.light == "red"]
    if red:
        msg = f"red: {', '.join(red)}; files wait in the journal and nothing is lost"
        raise ExportError(msg)
