"""How libraries and paints look on the command line."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import (
    lab_text,
    number_text,
    print_json,
    print_table,
    spec_document,
)

if TYPE_CHECKING:
    from paintlink.library import Histogram
    from paintlink.library.generations import Generation
    from paintlink.library.groups import Member
    from paintlink.library.shelf import Entry, Shelf
    from paintlink.library.virtual import Ingredient
    from paintlink.model import ColorSpec, PaintTable

FACE, MIDDLE, FLOP = 15.0, 45.0, 110.0
BLOCK = "\N{FULL BLOCK}"
BARS = " ▁▂▃▄▅▆▇█"
INDICES = ("flop_index", "hue_shift_index", "chroma_index")


def swatch(lab: Any, width: int = 2) -> str:
    """Some characters in the colour, for terminals that show colours."""
    from paintlink.color import lab_to_srgb

    red, green, blue = (int(value) for value in lab_to_srgb(lab))
    return click.style(BLOCK * width, fg=(red, green, blue))


def paint_document(table: PaintTable, row: int) -> dict[str, Any]:
    """A paint as a JSON document."""
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


def print_paints(table: PaintTable, documents: Sequence[dict[str, Any]]) -> None:
    """Print paints as a table with a swatch of face, middle and flop."""
    columns = ("", "code", "name", "finish", "Flop", "Hue Shift", "Chroma")
    rows = []
    for paint in documents:
        angles = [f"{angle:g}" for angle in (FACE, MIDDLE, FLOP)]
        colors = [paint["lab"][angle] for angle in angles if angle in paint["lab"]]
        rows.append((
            "".join(map(swatch, colors)),
            paint["code"],
            paint["name"],
            paint["finish"],
            *(number_text(paint[name]) for name in INDICES),
        ))
    print_table(columns, rows, title=table.library)


def show_paint(shelf: Shelf, table: PaintTable, row: int, *, as_json: bool) -> None:
    """Print everything that is known about a paint."""
    from paintlink.library import paint_spec
    from paintlink.library.groups import members
    from paintlink.library.loading import SPECIFICATION
    from paintlink.library.virtual import formula_of

    spec = paint_spec(table, row)
    extras = shelf.extras(table, row)
    extras.pop(SPECIFICATION, None)
    group = members(table, row)
    if as_json:
        print_json({
            **spec_document(spec),
            "library": table.library,
            "generation": table.generation,
            "synthetic": table.synthetic,
            "columns": extras,
            "formula": [one._asdict() for one in formula_of(table, row)],
            "group": [_member_document(table, one) for one in group],
        })
        return
    _print_colour(spec)
    formula = formula_of(table, row)
    if formula:
        extras.pop("formula", None)
        _print_formula(formula)
    for name, text in extras.items():
        click.echo(f"{name}: {text}")
    if group:
        _print_group(table, group)
    kind = "synthetic" if table.synthetic else "real"
    click.echo(
        f"{kind}, 45 degree light, D65/{spec.observer}; {table.library}, "
        f"generation {table.generation}"
    )


def _print_colour(spec: ColorSpec) -> None:
    from paintlink.color import travel

    rows = [
        (f"{one.aspecular_deg:g}", swatch(one.lab, 8), lab_text(one.lab))
        for one in spec.samples
    ]
    title = f"{spec.code} {spec.name}, {spec.finish}"
    columns = ("aspecular angle", "", f"L a b, D65/{spec.observer}")
    print_table(columns, rows, title=title)
    found = travel(spec)
    values = (
        f"{name.replace('_', ' ')} {number_text(getattr(found, name))}"
        for name in INDICES
    )
    click.echo(", ".join(values))
    if found.unstable:
        click.echo(
            "the flop index is unstable: the paint is nearly black at 45 degrees"
        )
    if spec.gloss:
        click.echo(f"gloss {spec.gloss.value_gu:g} GU at {spec.gloss.angle_deg:g} deg")


def _print_formula(formula: tuple[Ingredient, ...]) -> None:
    rows = [(one.code, one.name, f"{one.parts:.2f}") for one in formula]
    print_table(
        ("toner", "", "parts by weight"), rows, title="Formula (invented toners)"
    )


def _print_group(table: PaintTable, group: tuple[Member, ...]) -> None:
    angles = [f"dE at {angle:g}" for angle in table.angles_deg]
    rows = [
        (
            "".join(swatch(lab, 1) for lab in table.lab[one.row]),
            table.codes[one.row],
            one.variant,
            *(f"{value:.2f}" for value in one.differences),
        )
        for one in group
    ]
    print_table(("", "code", "variant", *angles), rows, title="Variants of the prime")


def _member_document(table: PaintTable, member: Member) -> dict[str, Any]:
    angles = (f"{angle:g}" for angle in table.angles_deg)
    return {
        "code": table.codes[member.row],
        "variant": member.variant,
        "dE": dict(zip(angles, member.differences, strict=True)),
    }


def entry_document(entry: Entry) -> dict[str, Any]:
    """A library on the shelf as a JSON document."""
    return {
        "name": entry.name,
        "title": entry.title,
        "own": entry.own,
        "paints": entry.paints,
        "generation": entry.generation,
        "angles_deg": list(entry.conditions.angles_deg),
        "observer": entry.conditions.observer,
        "synthetic": entry.conditions.synthetic,
        "change": entry.change,
        "made_at": entry.made_at,
    }


def print_entries(entries: Sequence[Entry]) -> None:
    """Print the libraries side by side."""
    rows = [
        (
            one.name,
            str(one.paints),
            "/".join(f"{angle:g}" for angle in one.conditions.angles_deg),
            f"D65/{one.conditions.observer}",
            "synthetic" if one.conditions.synthetic else "real",
            one.change if one.own else f"{one.title}, comes with paintlink",
            one.generation,
        )
        for one in entries
    ]
    columns = ("library", "paints", "angles", "light", "paints are", "", "generation")
    print_table(columns, rows)


def generation_document(generation: Generation) -> dict[str, Any]:
    """A generation as a JSON document."""
    return {
        "generation": generation.key,
        "number": generation.number,
        "library": generation.name,
        "removed": generation.removed,
        "paints": generation.paints,
        "change": generation.change,
        "made_at": generation.made_at,
    }


def say_changed(
    generation: Generation, as_json: bool, *, dry_run: bool = False
) -> None:
    """Print what became of a library, or would."""
    if as_json:
        print_json({**generation_document(generation), "dry_run": dry_run})
        return
    number = f"generation {generation.number}"
    number += "" if dry_run else f" ({generation.key})"
    words = f"{generation.change}; {number}, {generation.paints} paints"
    would = "dry run, nothing is stored: " if dry_run else ""
    click.echo(f"{would}{generation.name}: {words}")


def print_histogram(found: Histogram) -> None:
    """Print a histogram as one line of bars."""
    highest = max(*found.counts, 1)
    steps = len(BARS) - 1
    bars = "".join(BARS[-(-count * steps // highest)] for count in found.counts)
    beyond = f", {found.beyond} above" if found.beyond else ""
    undefined = f", {found.undefined} undefined" if found.undefined else ""
    name = found.index.replace("_", " ")
    last = f"{found.edges[-1]:g}"
    click.echo(f"{name:>9} index 0 {bars} {last}{beyond}{undefined}")
