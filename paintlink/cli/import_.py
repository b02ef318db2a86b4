"""`paintlink import`: colours from the files of instruments and other programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json
from paintlink.cli.progress import bar
from paintlink.cli.state import config_option, settings_of

if TYPE_CHECKING:
    from paintlink.cli.imports import Report
    from paintlink.config import Settings
    from paintlink.intake import Options

EPILOG = """\b
Examples:
  paintlink import --dry-run readings.xlsx     look first
  paintlink import *.cxf                       send everything down the line
  paintlink import readings.json --to colours  specifications as files
  paintlink import table.csv --make-profile -o shop.toml
  paintlink import table.csv --profile shop.toml

\b
Exit codes:
  0  everything was imported
  2  wrong call or configuration
  3  a file or a colour was refused; all others were imported
  5  a file could not be written
  6  the journal cannot be used
"""


@click.command("import", short_help="Import readings from files.", epilog=EPILOG)
@click.argument("files", nargs=-1, type=click.Path(path_type=Path))
@click.option("--dry-run", is_flag=True, help="Say what would be imported, no more.")
@click.option(
    "--to",
    "folder",
    type=click.Path(path_type=Path, file_okay=False),
    help="Write specifications into this folder; nothing goes down the line.",
)
@click.option("--format", "format_id", default="", help="Format; found by content.")
@click.option("--list-formats", is_flag=True, help="List the formats and exit.")
@click.option(
    "--finish",
    type=click.Choice(["solid", "metallic", "pearl", "unknown"]),
    default="unknown",
    help="Finish of colours whose file names none; solid admits single angles.",
)
@click.option(
    "--scale",
    type=click.Choice(["fraction", "percent"]),
    help="Scale of reflectance, where a file does not keep to its format.",
)
@click.option("--geometry", default="", help="Geometry of values that name none.")
@click.option("--data-mode", default="", help="Mode to take from files with several.")
@click.option(
    "--average", is_flag=True, help="Take the mean of all readings of one name."
)
@click.option("--time-zone", help="Zone of times without one, such as Europe/Berlin.")
@click.option(
    "--profile",
    "profiles",
    multiple=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="Mapping of a table; may be repeated.",
)
@click.option(
    "--make-profile", is_flag=True, help="Propose a mapping for one table and exit."
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="File for the proposed mapping; standard output when left out.",
)
@json_option
@config_option
def command(
    *,
    files: tuple[Path, ...],
    dry_run: bool,
    folder: Path | None,
    format_id: str,
    list_formats: bool,
    make_profile: bool,
    average: bool,
    output: Path | None,
    as_json: bool,
    config: Path | None,
    **hints: Any,
) -> None:
    """Import readings from FILES: workbooks, CxF, JSON, tables, printed reports.

    The content tells the format, not the name. Each colour goes down the line as if it
    had been measured here: nearest paint, deliveries. A reading is imported once, from
    however many files.
    """
    if list_formats:
        _list_formats(as_json=as_json)
        return
    if not files:
        msg = "name the files to import, or see `paintlink import --list-formats`"
        raise click.UsageError(msg)
    if make_profile:
        _make_profile(files, output)
        return
    settings = settings_of(config)
    options = _options(settings, **hints)
    reports = _reports(files, format_id, options)
    if average:
        reports = map(_averaged, reports)
    if dry_run:
        done = list(reports)
    elif folder is not None:
        done = _written(reports, folder)
    else:
        done = _queued(reports, settings)
    _finish(done, as_json=as_json)


def _list_formats(*, as_json: bool) -> None:
    from paintlink.intake import importer_failures, importers

    formats = {name: one.INFO.label for name, one in importers().items()}
    if as_json:
        print_json({"formats": formats, "broken": importer_failures()})
        return
    for name, label in formats.items():
        click.echo(f"{name:<16} {label}")
    for fault in importer_failures().values():
        click.secho(f"left out: {fault}", fg="red", err=True)


def _make_profile(files: Sequence[Path], output: Path | None) -> None:
    from paintlink.cli.files import write_new
    from paintlink.intake import open_source, propose

    if len(files) != 1:
        msg = "--make-profile looks at one table: name one file"
        raise click.UsageError(msg)
    proposal = propose(open_source(files[0]))
    if output is None:
        click.echo(proposal.text, nl=False)
    else:
        write_new(output, proposal.text.encode())
        click.echo(f"wrote {output}", err=True)
    for doubt in proposal.doubts:
        click.echo(f"check {doubt}", err=True)


def _options(
    settings: Settings,
    *,
    time_zone: str | None,
    geometry: str,
    profiles: Sequence[Path],
    **hints: Any,
) -> Options:
    from paintlink.intake import Options, load_profile, load_profiles

    return Options(
        zone=_zone(time_zone) if time_zone else None,
        geometry=_geometry(geometry),
        profiles=(
            *map(load_profile, profiles),
            *load_profiles(settings.profiles_folder),
        ),
        **hints,
    )


def _geometry(code: str) -> str:
    from paintlink.errors import ConfigError, InputError
    from paintlink.intake.geometries import read_geometry

    try:
        return read_geometry(code).code if code else ""
    except InputError as error:
        msg = f"--geometry: {error}"
        raise ConfigError(msg) from error


def _zone(name: str) -> Any:
    from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

    from paintlink.errors import ConfigError

    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError) as error:
        msg = f"unknown time zone {name!r}: write one such as Europe/Berlin or UTC"
        raise ConfigError(msg) from error


def _reports(
    files: Sequence[Path], format_id: str, options: Options
) -> Iterator[Report]:
    from paintlink.cli.imports import report_on

    for path in _progress(files):
        yield report_on(path, format_id, options)


def _averaged(report: Report) -> Report:
    from dataclasses import replace

    from paintlink.daemon.imports import averaged

    return replace(report, found=report.found and averaged(report.found))


def _progress(files: Sequence[Path]) -> Iterator[Path]:
    """The files, behind a bar where there are many and a person watches."""
    with bar(len(files), "Reading") as advance:
        for path in files:
            yield path
            advance(1)


def _queued(reports: Iterable[Report], settings: Settings) -> list[Report]:
    from paintlink.cli.imports import queue, with_nearest
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.oneshot import work_off

    with Journal(settings.journal_path) as journal:
        done = [queue(report, journal) for report in reports]
        jobs = sum(len(report.outcomes) for report in done)
        routes = sum(route.enabled for route in settings.routes)
        with bar(jobs * (1 + routes), "Down the line") as advance:
            worked = work_off(settings, journal, lambda: advance(1))
        if not worked:
            click.echo("the running service takes it from here", err=True)
        return [with_nearest(report, journal) for report in done]


def _written(reports: Iterable[Report], folder: Path) -> list[Report]:
    from paintlink.cli.imports import write

    return [write(report, folder) for report in reports]


def _finish(reports: Sequence[Report], *, as_json: bool) -> None:
    from paintlink.cli.imports import document, print_reports
    from paintlink.errors import InputError

    if as_json:
        print_json([document(report) for report in reports])
    else:
        print_reports(reports)
    if any(report.faulty for report in reports):
        raise SystemExit(InputError.exit_code)
