"""`paintlink library`: the known paints, browsed as in a colour book."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli import library_changes, library_files, library_pictures
from paintlink.cli.library_state import Where, filter_of, filter_options, on_shelf
from paintlink.cli.library_views import (
    entry_document,
    generation_document,
    paint_document,
    print_entries,
    print_histogram,
    print_paints,
    show_paint,
)
from paintlink.cli.output import json_option, print_json, print_table

if TYPE_CHECKING:
    from paintlink.library.shelf import Shelf


@click.group("library", short_help="Browse and keep the known paints.")
def command() -> None:
    """Browse the known paints, and keep libraries of your own.

    The library `virtual` comes with paintlink: 6000 synthetic paints of no brand.
    Import your own with `paintlink library import paints.csv --into NAME`.
    """


for one in (
    *library_changes.COMMANDS,
    *library_files.COMMANDS,
    *library_pictures.COMMANDS,
):
    command.add_command(one)


@command.command("libraries")
@click.option("--removed", is_flag=True, help="List those that were removed.")
@on_shelf
@json_option
def libraries(shelf: Shelf, removed: bool, as_json: bool) -> None:
    """List all libraries side by side."""
    from paintlink.library.shelf import own_entry

    gone = map(own_entry, shelf.own.removed())
    entries = tuple(gone) if removed else shelf.entries()
    if as_json:
        print_json([entry_document(one) for one in entries])
    else:
        print_entries(entries)


@command.command("stats")
@on_shelf
@Where.options
@json_option
def stats(shelf: Shelf, where: Where, as_json: bool) -> None:
    """Count paints by finish and drawer, and say how much they flop."""
    from paintlink.library import INDEX_NAMES, Filter, histogram, statistics

    table = where.table(shelf)
    found = statistics(table)
    effects = Filter(finishes=("metallic", "pearl", "unknown"))
    histograms = [histogram(table, name, effects) for name in INDEX_NAMES]
    if as_json:
        from dataclasses import asdict

        print_json({
            "library": table.library,
            "generation": table.generation,
            "synthetic": table.synthetic,
            "paints": found.paints,
            "by_finish": found.by_finish,
            "drawers": _drawers(found.by_leaf),
            "mean_flop_index": found.mean_flop_index,
            "usual_flop_share": found.usual_flop_share,
            "steep_flop_paints": found.steep_flop_paints,
            "histograms": [asdict(one) for one in histograms],
        })
        return
    rows = [
        (kind, family, str(count)) for kind, family, count in _drawers(found.by_leaf)
    ]
    print_table(("set", "drawer", "paints"), rows, title=table.library)
    counts = ", ".join(f"{n} {finish}" for finish, n in found.by_finish.items() if n)
    click.echo(f"{found.paints} paints: {counts}; generation {table.generation}")
    if found.mean_flop_index is not None:
        mean = f"{found.mean_flop_index:.2f}"
        click.echo(f"mean Flop Index of metallics and pearls {mean}")
        for one in histograms:
            print_histogram(one)


@command.command("tree")
@on_shelf
@Where.options
@filter_options
@json_option
def tree(shelf: Shelf, where: Where, as_json: bool, **wanted: Any) -> None:
    """Show the drawers as the book has them, with the number of paints in each."""
    from paintlink.library.tree import counts

    table = where.table(shelf)
    found = counts(table, filter_of(**wanted).mask(table))
    if as_json:
        print_json(found.document())
        return
    click.echo(f"{table.library}: {found.paints}")
    for depth, name, paints in found.lines():
        click.echo(f"{'  ' * depth}{name}: {paints}")


@command.command("list")
@on_shelf
@Where.options
@filter_options
@click.option("-n", "--limit", default=20, show_default=True, help="Rows to print.")
@json_option
def list_paints(
    *, shelf: Shelf, where: Where, limit: int, as_json: bool, **wanted: Any
) -> None:
    """List paints whose code or name contains TEXT, narrowed by the options."""
    import numpy as np

    table = where.table(shelf)
    rows = np.flatnonzero(filter_of(**wanted).apply(table))
    documents = [paint_document(table, int(row)) for row in rows[:limit]]
    if as_json:
        print_json(documents)
        return
    print_paints(table, documents)
    click.echo(f"{len(documents)} of {len(rows)} paints")


@command.command("show")
@click.argument("code")
@on_shelf
@Where.options
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the paint's colour specification to this file.",
)
@json_option
def show(
    code: str, shelf: Shelf, where: Where, output: Path | None, as_json: bool
) -> None:
    """Show one paint by its CODE, in colour where the terminal can."""
    from paintlink.library import find

    table = where.table(shelf)
    row = find(table, code)
    if output is not None:
        from paintlink.cli.files import write_new
        from paintlink.cli.library_specs import full_spec
        from paintlink.library.loading import SPECIFICATION
        from paintlink.spec import write_spec

        document = shelf.extras(table, row).get(SPECIFICATION, "")
        write_new(output, write_spec(full_spec(table, row, document)))
        click.echo(f"wrote {output}", err=True)
    show_paint(shelf, table, row, as_json=as_json)


@command.command("history")
@click.argument("name")
@on_shelf
@json_option
def history(name: str, shelf: Shelf, as_json: bool) -> None:
    """List every generation of the library NAME."""
    generations = shelf.own.history(shelf.own_head(name))
    if as_json:
        print_json([generation_document(one) for one in generations])
        return
    rows = [
        (str(one.number), one.key, one.made_at, one.name, str(one.paints), one.change)
        for one in generations
    ]
    print_table(("", "generation", "made", "library", "paints", "change"), rows)


def _drawers(by_leaf: dict[Any, int]) -> list[tuple[str, str, int]]:
    return [(leaf.paint_set, leaf.family, count) for leaf, count in by_leaf.items()]
