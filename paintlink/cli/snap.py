"""`paintlink snap`: the nearest known paints, of one target or of thousands."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.answers import answer_document, print_answer, write_graph
from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.config import SnapSettings
    from paintlink.model import Finish, PaintTable
    from paintlink.snap import Options
    from paintlink.snap.grown import Mask

BUNDLED = "virtual"


@click.command("snap", short_help="Find the nearest known paints.")
@click.argument("target", type=click.Path(path_type=Path))
@click.option("-k", "--top", default=5, show_default=True, help="How many paints.")
@click.option(
    "-m",
    "--metric",
    help="Difference formula: cie76 (the paper's), ciede2000, cie94, cmc, din99, "
    "din6175. By default the configured one, cie76.",
)
@click.option(
    "--finish",
    "finishes",
    multiple=True,
    type=click.Choice(["solid", "metallic", "pearl"]),
    help="Only paints of this finish; may be repeated.",
)
@click.option(
    "-l",
    "--library",
    "libraries",
    multiple=True,
    default=(BUNDLED,),
    show_default=True,
    help="Library to search, see `paintlink library libraries`; may be repeated.",
)
@click.option(
    "--where",
    "conditions",
    multiple=True,
    metavar="COLUMN=VALUE",
    help="Only paints such as brand=Alpha or year=2015..2020; may be repeated.",
)
@click.option(
    "--angles",
    help="Aspecular angles to compare at, such as 25,45,75; by default 15,45,110 "
    "where both sides have them.",
)
@click.option(
    "--graph",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Draw target, nearest paints and library in Lab space: .png, .svg, or .json "
    "for plotly.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Of many targets: file for the lists; - for standard output.",
)
@click.option(
    "--config",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Configuration file with the limits of the diagnosis.",
)
@json_option
def command(
    *,
    target: Path,
    top: int,
    metric: str | None,
    finishes: tuple[Finish, ...],
    libraries: tuple[str, ...],
    conditions: tuple[str, ...],
    angles: str | None,
    graph: Path | None,
    output: Path | None,
    config: Path | None,
    as_json: bool,
) -> None:
    """Find the known paints nearest to TARGET, a colour specification.

    Ranked by the sum of the colour differences at the aspecular angles 15, 45 and 110
    degrees; ties go to the smaller paint id. Differences are target minus paint:
    "face 1.2 lighter" means that the target is lighter than the paint.

    TARGET may also be a folder of specifications, or a table (.csv) with one colour in
    each row and columns like code, L15, a15, b15: then a CSV table of the lists is
    written, or JSON Lines with --json.
    """
    from paintlink.config import load_snap_settings

    settings = load_snap_settings(config, environ=os.environ)
    options = options_of(settings, top=top, metric=metric, angles=_angles(angles))
    tables = _tables(libraries, config)
    masks = _masks(tables, finishes, conditions)
    if target.is_dir() or target.suffix.lower() in {".csv", ".tsv", ".txt"}:
        from paintlink.cli.snap_many import snap_many

        if graph is not None:
            msg = "--graph draws one target: name one specification"
            raise click.UsageError(msg)
        if len(tables) > 1:
            msg = "many targets are compared with one library: name one with --library"
            raise click.UsageError(msg)
        snap_many(target, tables[0], options, masks[0], output=output, as_json=as_json)
        return
    if output is not None:
        msg = "--output is for a folder or a table of targets: leave it out"
        raise click.UsageError(msg)
    from paintlink.snap import answer_of_all
    from paintlink.spec import read_spec_file

    spec = read_spec_file(target)
    found = answer_of_all(spec, tables, options, masks)
    if as_json:
        print_json(answer_document(found))
    else:
        print_answer(spec, found, settings)
    if graph is not None:
        first = next(t for t in tables if t.library == found.matches[0].library)
        write_graph(graph, spec, found.matches, first)


def _tables(libraries: tuple[str, ...], config: Path | None) -> list[PaintTable]:
    """The libraries of these names; the shelf is opened only for the shop's own."""
    if set(libraries) <= {BUNDLED}:
        from paintlink.library import bundled

        return [bundled()]
    from paintlink.cli.state import settings_of
    from paintlink.library import Shelf

    shelf = Shelf(settings_of(config).library_path)
    return [shelf.table(name) for name in dict.fromkeys(libraries)]


def _masks(
    tables: list[PaintTable], finishes: tuple[Finish, ...], conditions: tuple[str, ...]
) -> list[Mask | None]:
    if not (finishes or conditions):
        return [None] * len(tables)
    from paintlink.library import Filter, parse_choices

    chosen = Filter(finishes=finishes, facets=parse_choices(conditions))
    return [chosen.apply(table) for table in tables]


def options_of(
    settings: SnapSettings,
    *,
    top: int,
    metric: str | None = None,
    angles: tuple[float, ...] | None = None,
) -> Options:
    """What the configuration and the command line ask for."""
    from paintlink.snap import Limits, Options

    return Options(
        top=top,
        formula=metric or settings.formula,
        angles_deg=angles,
        repeatability=settings.repeatability,
        limits=Limits(
            outside=settings.outside,
            sparse=settings.sparse,
            too_chromatic=settings.too_chromatic,
            off_radial=settings.off_radial,
            face_and_flop=settings.face_and_flop,
            flop_index=settings.flop_index,
        ),
    )


def _angles(text: str | None) -> tuple[float, ...] | None:
    if text is None:
        return None
    try:
        return tuple(float(part) for part in text.replace("/", ",").split(","))
    except ValueError as error:
        msg = f"--angles {text!r}: write numbers with commas between, such as 25,45,75"
        raise click.UsageError(msg) from error
