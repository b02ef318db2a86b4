"""`paintlink library`: the known paints, browsed as in a colour book."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import (
    json_option,
    lab_text,
    number_text,
    print_json,
    print_table,
    spec_document,
)

if TYPE_CHECKING:
    from paintlink.library import Filter
    from paintlink.model import Finish, PaintTable

FACE, MIDDLE, FLOP = 15.0, 45.0, 110.0
BLOCK = "\N{FULL BLOCK}" * 2

Range = tuple[float, float]


@click.group("library", short_help="Browse the known paints.")
def command() -> None:
    """Browse the known paints. The bundled ones are synthetic: no real brand."""


@command.command("stats")
@json_option
def stats(as_json: bool) -> None:
    """Count paints by finish and drawer, and say how much they flop."""
    from paintlink.library import bundled, statistics

    table = bundled()
    found = statistics(table)
    drawers = [
        (leaf.paint_set, leaf.family, count) for leaf, count in found.by_leaf.items()
    ]
    if as_json:
        print_json({
            "library": table.library,
            "generation": table.generation,
            "synthetic": table.synthetic,
            "paints": found.paints,
            "by_finish": found.by_finish,
            "drawers": drawers,
            "mean_flop_index": found.mean_flop_index,
        })
        return
    rows = [(paint_set, family, str(count)) for paint_set, family, count in drawers]
    print_table(("set", "drawer", "paints"), rows, title=table.library)
    counts = ", ".join(f"{n} {finish}" for finish, n in found.by_finish.items() if n)
    click.echo(f"{found.paints} paints: {counts}; generation {table.generation}")
    click.echo(f"mean Flop Index of metallics and pearls {found.mean_flop_index:.2f}")


@command.command("list")
@click.argument("text", default="")
@click.option(
    "--finish",
    "finishes",
    multiple=True,
    type=click.Choice(["solid", "metallic", "pearl"]),
    help="Only this finish; may be repeated.",
)
@click.option("--drawer", "drawers", multiple=True, help="Such as red, or dark.")
@click.option("--flop", type=(float, float), help="Lowest and highest Flop Index.")
@click.option("--hue-shift", type=(float, float), help="Of the Hue Shift Index.")
@click.option("--chroma", type=(float, float), help="Of the Chroma Index.")
@click.option("-n", "--limit", default=20, show_default=True, help="Rows to print.")
@json_option
def list_paints(*, limit: int, as_json: bool, **wanted: Any) -> None:
    """List paints whose code or name contains TEXT, narrowed by the options."""
    import numpy as np

    from paintlink.library import bundled

    table = bundled()
    rows = np.flatnonzero(_filter(**wanted).apply(table))
    documents = [_document(table, int(row)) for row in rows[:limit]]
    if as_json:
        print_json(documents)
        return
    columns = ("", "code", "name", "finish", "Flop", "Hue Shift", "Chroma")
    print_table(columns, [_row(one) for one in documents], title=table.library)
    click.echo(f"{len(documents)} of {len(rows)} paints")


@command.command("show")
@click.argument("code")
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the paint's colour specification to this file.",
)
@json_option
def show(code: str, output: Path | None, as_json: bool) -> None:
    """Show one paint by its CODE, in colour where the terminal can."""
    from paintlink.library import bundled, find, paint_spec

    table = bundled()
    row = find(table, code)
    spec = paint_spec(table, row)
    if output is not None:
        from paintlink.cli.files import write_new
        from paintlink.spec import write_spec

        write_new(output, write_spec(spec))
        click.echo(f"wrote {output}", err=True)
    if as_json:
        print_json(spec_document(spec))
        return
    rows = [
        (f"{one.aspecular_deg:g}", _swatch(one.lab), lab_text(one.lab))
        for one in spec.samples
    ]
    title = f"{code} {spec.name}, {spec.finish}"
    print_table(
        ("aspecular angle", "", f"L a b, D65/{spec.observer}"), rows, title=title
    )
    known = _document(table, row)
    names = ("flop_index", "hue_shift_index", "chroma_index")
    values = (f"{name.replace('_', ' ')} {number_text(known[name])}" for name in names)
    click.echo(", ".join(values))
    click.echo(f"{table.library}, generation {table.generation}")


def _filter(
    *,
    text: str,
    finishes: tuple[Finish, ...],
    drawers: tuple[str, ...],
    flop: Range | None,
    hue_shift: Range | None,
    chroma: Range | None,
) -> Filter:
    from paintlink.color import FAMILIES, LEAVES
    from paintlink.errors import ConfigError
    from paintlink.library import Filter

    unknown = [name for name in drawers if name not in FAMILIES]
    if unknown:
        msg = f"no drawer {unknown[0]!r}: take {', '.join(FAMILIES)}"
        raise ConfigError(msg)
    leaves = tuple(leaf for leaf in LEAVES if leaf.family in drawers)
    return Filter(finishes, leaves, flop, hue_shift, chroma, text)


def _document(table: PaintTable, row: int) -> dict[str, Any]:
    from paintlink.color import travel
    from paintlink.library import paint_spec

    spec = paint_spec(table, row)
    found = travel(spec)
    return {
        "code": spec.code,
        "name": spec.name,
        "finish": spec.finish,
        "flop_index": found.flop_index,
        "hue_shift_index": found.hue_shift_index,
        "chroma_index": found.chroma_index,
        "lab": {f"{one.aspecular_deg:g}": list(one.lab) for one in spec.samples},
    }


def _row(paint: dict[str, Any]) -> tuple[str, ...]:
    lab = paint["lab"]
    swatches = "".join(_swatch(lab[f"{angle:g}"]) for angle in (FACE, MIDDLE, FLOP))
    indices = ("flop_index", "hue_shift_index", "chroma_index")
    return (
        swatches,
        paint["code"],
        paint["name"],
        paint["finish"],
        *(number_text(paint[name]) for name in indices),
    )


def _swatch(lab: Any) -> str:
    """Two characters in the colour, for terminals that show colours."""
    from paintlink.color import lab_to_srgb

    red, green, blue = (int(value) for value in lab_to_srgb(lab))
    return click.style(BLOCK, fg=(red, green, blue))
