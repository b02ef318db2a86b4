"""`paintlink library import` and `export`: libraries from files and into files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.library_state import Where, on_shelf
from paintlink.cli.library_views import say_changed
from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.errors import ImportRefusedError
    from paintlink.library.incoming import Incoming, Progress
    from paintlink.library.merging import Mode
    from paintlink.library.profile import Profile
    from paintlink.library.shelf import Shelf

SHOWN_REFUSALS = 20
TABLES = {".csv", ".tsv", ".txt"}
"""Suffixes of tables; the format of all other files is told by their content."""


@click.command("import")
@click.argument("source", type=click.Path(path_type=Path))
@click.option("--into", "name", required=True, help="Library, made when there is none.")
@click.option("--update", "mode", flag_value="update", help="Change paints it has.")
@click.option(
    "--replace", "mode", flag_value="replace", help="Hold these paints and no others."
)
@click.option("--dry-run", is_flag=True, help="Say what would happen, change nothing.")
@click.option(
    "--map",
    "columns",
    multiple=True,
    metavar="FIELD=HEADING",
    help='Where a field stands, such as code="Paint No" or L15="L* 15".',
)
@click.option(
    "--profile",
    type=click.Path(path_type=Path, dir_okay=False),
    help="TOML file that says how the table is written; see docs/library.md.",
)
@click.option("--encoding", default="", help="Such as cp1252; UTF-8 when not given.")
@click.option(
    "--observer",
    type=click.Choice(["10", "2"]),
    help="Of a table that does not say it; 10 when not given.",
)
@click.option(
    "--report",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write every refusal to this file.",
)
@on_shelf
@json_option
def import_paints(
    *,
    source: Path,
    name: str,
    mode: Mode | None,
    dry_run: bool,
    report: Path | None,
    shelf: Shelf,
    as_json: bool,
    **how: Any,
) -> None:
    """Import SOURCE: a CSV table, a CxF file, or a folder of colour specifications.

    All of it or nothing: when a row is refused, the library stays as it was, and every
    refused row is named with its line. Interrupt it whenever you like.
    """
    from paintlink.errors import CancelledError, ImportRefusedError

    try:
        incoming = _read(source, _profile(**how))
        with _bar("Storing") as progress:
            made = shelf.editor.import_paints(
                name, incoming, mode or "add", dry_run=dry_run, progress=progress
            )
    except ImportRefusedError as error:
        _report(error, report, as_json=as_json)
        raise
    except KeyboardInterrupt as error:
        msg = "stopped; the libraries stay as they were"
        raise CancelledError(msg) from error
    say_changed(made, as_json, dry_run=dry_run)


@click.command("export")
@click.argument("target", type=click.Path(path_type=Path))
@on_shelf
@Where.options
@json_option
def export_paints(target: Path, shelf: Shelf, where: Where, as_json: bool) -> None:
    """Write a library to TARGET: a .csv table, or else a folder of specifications."""
    table = where.table(shelf)
    if target.suffix.casefold() == ".csv":
        from paintlink.cli.files import write_lines
        from paintlink.library.csv_export import csv_lines

        write_lines(target, csv_lines(table))
    else:
        from paintlink.cli.library_specs import write_folder

        with _bar("Writing") as progress:
            write_folder(target, shelf, table, progress)
    if as_json:
        print_json({
            "library": table.library,
            "generation": table.generation,
            "paints": len(table),
            "path": str(target),
        })
        return
    click.echo(f"wrote {len(table)} paints of {table.library} to {target}")


def _read(source: Path, profile: Profile) -> Incoming:
    with _bar("Reading") as progress:
        if source.is_dir():
            from paintlink.cli.library_specs import read_folder

            return read_folder(source, progress=progress)
        if source.suffix.casefold() not in TABLES:
            from paintlink.cli.library_specs import read_colours

            return read_colours(source, progress=progress)
        from paintlink.library.csv_file import read_csv

        return read_csv(source, profile, progress=progress)


def _profile(
    *, columns: tuple[str, ...], profile: Path | None, encoding: str, observer: Any
) -> Profile:
    from dataclasses import replace

    from paintlink.errors import ConfigError
    from paintlink.library.profile import Profile, read_profile

    found = read_profile(profile) if profile else Profile()
    pairs = {}
    for text in columns:
        field, sign, heading = text.partition("=")
        if not (field and sign and heading):
            msg = f"--map {text!r}: write it as FIELD=HEADING, such as code=Number"
            raise ConfigError(msg)
        pairs[field.strip()] = heading.strip()
    return replace(
        found.with_columns(pairs),
        encoding=encoding or found.encoding,
        observer=observer or found.observer,
    )


def _report(error: ImportRefusedError, path: Path | None, *, as_json: bool) -> None:
    if path is not None:
        from paintlink.cli.files import write_lines

        write_lines(path, (f"{one}\n" for one in error.refusals), replace=True)
    if as_json:
        refusals = [{"place": one.place, "what": one.what} for one in error.refusals]
        print_json({
            "source": error.source,
            "stopped": error.stopped,
            "refusals": refusals,
        })
        return
    for one in error.refusals[:SHOWN_REFUSALS]:
        click.echo(str(one), err=True)
    more = len(error.refusals) - SHOWN_REFUSALS
    if more > 0:
        click.echo(f"and {more} more; --report FILE names all of them", err=True)


@contextmanager
def _bar(what: str) -> Iterator[Progress]:
    """A progress bar where a person watches."""
    import sys

    from rich.console import Console
    from rich.progress import Progress as Bar

    hidden = not sys.stderr.isatty()
    with Bar(console=Console(stderr=True), transient=True, disable=hidden) as bar:
        task = bar.add_task(what, total=1.0)
        yield lambda share: bar.update(task, completed=share)


COMMANDS = (import_paints, export_paints)
