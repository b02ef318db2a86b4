"""`paintlink design`: a colour made by named steps on a starting colour."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from paintlink.cli.designs import (
    kind_document,
    nearest_paint,
    paint_of,
    show_design,
)
from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.design import Design, Start, Step
    from paintlink.model import ColorSpec

EXAMPLE = """\b
Example:
  paintlink design new sea.json --paint BM419
  paintlink design apply sea.json rotate-hue angle_deg=-50
  paintlink design export sea.json -o sea.xml
"""
SUFFIXES = {".png": "png", ".svg": "svg"}

file_argument = click.argument("file", type=click.Path(path_type=Path))
count_argument = click.argument("count", type=int, default=1)
output_option = click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="File to write; an older one is replaced.",
)


@click.group("design", short_help="Design a colour by named steps.", epilog=EXAMPLE)
def command() -> None:
    """Design a colour: start from a paint, make steps, take them back, export.

    A design is a JSON file that holds its start and every step.
    """


@command.command("new", short_help="Start a design.")
@file_argument
@click.option("--paint", metavar="CODE", help="Start from a paint of the library.")
@click.option(
    "--spec",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Start from a specification file.",
)
@click.option("--blank", is_flag=True, help="Start from a middle grey.")
@click.option(
    "--angles",
    type=click.Choice(["3", "5"]),
    help="Aspecular angles: 15/45/110 or 15/25/45/75/110; those of the "
    "specification, else 3, when left out.",
)
@click.option("--name", help="Name of the design; that of its start when left out.")
@json_option
def new(
    *,
    file: Path,
    paint: str | None,
    spec: Path | None,
    blank: bool,
    angles: str | None,
    name: str | None,
    as_json: bool,
) -> None:
    """Start the design FILE from a known paint, a specification, or a grey."""
    from paintlink.design import Design, write_design
    from paintlink.errors import ExportError

    if [paint is not None, spec is not None, blank].count(True) != 1:
        msg = "say what to start from: one of --paint CODE, --spec FILE, --blank"
        raise click.UsageError(msg)
    if file.exists():
        msg = f"{file} exists: choose another name, or remove it first"
        raise ExportError(msg, kind="exists")
    start = _start(paint, spec, int(angles) if angles else None)
    design = Design(name or f"Design on {start.spec.name}", start)
    write_design(file, design)
    show_design(design, as_json)


@command.command("apply", short_help="Make a step.")
@file_argument
@click.argument("step")
@click.argument("parameters", nargs=-1, metavar="[NAME=VALUE]...")
@json_option
def apply(file: Path, step: str, parameters: tuple[str, ...], as_json: bool) -> None:
    """Make the step STEP on the design FILE; `paintlink design steps` lists them.

    A step that would leave the colours a surface can have is made as far as possible,
    and says how far. A colour is given as L,a,b, a paint by its code or a file.
    """
    made = _step(step, dict(_pair(one) for one in parameters))
    _change(file, lambda design: design.apply(made), as_json)


@command.command("undo", short_help="Take back steps.")
@file_argument
@count_argument
@json_option
def undo(file: Path, count: int, as_json: bool) -> None:
    """Take back the last step of the design FILE, or the last COUNT."""
    _change(file, lambda design: design.undo(count), as_json)


@command.command("redo", short_help="Make undone steps again.")
@file_argument
@count_argument
@json_option
def redo(file: Path, count: int, as_json: bool) -> None:
    """Make the step undone last again, or the last COUNT."""
    _change(file, lambda design: design.redo(count), as_json)


@command.command("show", short_help="Show the colour and its steps.")
@file_argument
@json_option
def show(file: Path, as_json: bool) -> None:
    """Show the steps, Lab, indices and nearest paint of the design FILE."""
    from paintlink.design import read_design

    show_design(read_design(file), as_json)


@command.command("steps", short_help="List the steps and their parameters.")
@json_option
def steps(as_json: bool) -> None:
    """List all steps with their parameters, limits and defaults."""
    from paintlink.design import STEPS

    documents = [kind_document(kind) for kind in STEPS.values()]
    if as_json:
        print_json(documents)
        return
    for document in documents:
        click.secho(document["step"], bold=True, nl=False)
        click.echo(f"  {document['summary']}")
        for name, parameter in document["parameters"].items():
            default = parameter["default"]
            usual = f" (default {default})" if default is not None else ""
            optional = "" if parameter["required"] or usual else " (optional)"
            click.echo(f"    {name}: {parameter['limits']}{usual}{optional}")


@command.command("export", short_help="Write the colour as a specification.")
@file_argument
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="XML file to write, refused when it exists.",
)
def export(file: Path, output: Path) -> None:
    """Write the design FILE as an XML specification, with its nearest paint."""
    from paintlink.cli.files import write_new
    from paintlink.cli.render import with_starting_paint
    from paintlink.design import read_design
    from paintlink.spec import write_spec

    spec = with_starting_paint(read_design(file).spec)
    write_new(output, write_spec(spec))
    click.echo(f"wrote {output}")


@command.command("plot", short_help="Draw the curves of the colour.")
@file_argument
@output_option
def plot(file: Path, output: Path) -> None:
    """Draw L, a, b against the aspecular angle, and the travel in the a-b plane.

    The picture is PNG or SVG, by the ending of its name. It shows the start, the design
    and the nearest paint. Needs matplotlib: pip install 'paintlink[plots]'.
    """
    from paintlink.cli.files import write_new
    from paintlink.design import plot, read_design

    if output.suffix.lower() not in SUFFIXES:
        msg = f"{output}: the curves are PNG or SVG: end the name in .png or .svg"
        raise click.UsageError(msg)
    design = read_design(file)
    format: Literal["png", "svg"] = "svg" if output.suffix.lower() == ".svg" else "png"
    nearest = paint_of(nearest_paint(design.spec), design)
    data = plot(design.start.spec, design.spec, nearest, format=format)
    write_new(output, data, replace=True)
    click.echo(f"wrote {output}")


@command.command("preview", short_help="Draw what the paint looks like.")
@file_argument
@output_option
@click.option(
    "--beside",
    multiple=True,
    type=click.Choice(["start", "nearest"]),
    help="What to draw left or right of the design; may be repeated.",
)
@click.option("--object", "object_id", default="panel", show_default=True)
@click.option("--light", default="studio", show_default=True)
@click.option("--size", default=512, show_default=True, help="Pixels, 16 to 4096.")
def preview(
    *,
    file: Path,
    output: Path,
    beside: tuple[str, ...],
    object_id: str,
    light: str,
    size: int,
) -> None:
    """Draw the design FILE, from left to right: start, design, nearest paint."""
    from paintlink.cli.files import write_new
    from paintlink.cli.preview import cache_folder
    from paintlink.design import read_design
    from paintlink.preview import render, to_png, with_caption

    design = read_design(file)
    specs = [design.spec]
    if "start" in beside:
        specs.insert(0, design.start.spec)
    if "nearest" in beside:
        specs.append(paint_of(nearest_paint(design.spec), design))
    picture = render(
        specs, object=object_id, light=light, size=size, cache_dir=cache_folder()
    )
    write_new(output, to_png(with_caption(picture)), replace=True)
    click.echo(f"wrote {output} ({picture.backend}: {picture.reason})")


def _start(paint: str | None, spec: Path | None, count: int | None) -> Start:
    from paintlink.design import blank, from_library, from_spec
    from paintlink.library import bundled
    from paintlink.spec import read_spec_file

    if paint is not None:
        return from_library(bundled(), paint, count=count or 3)
    if spec is not None:
        return from_spec(read_spec_file(spec), spec.name, count=count)
    return blank(count=count or 3)


def _pair(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals:
        msg = f"{text!r} is no parameter: write NAME=VALUE, such as angle_deg=30"
        raise click.UsageError(msg)
    return name, value


def _step(name: str, texts: dict[str, str]) -> Step:
    from paintlink.design import Paint, kind_of, make_step, parameters, value_from_text

    known = parameters(kind_of(name))
    values = {
        key: _paint(text)
        if key in known and isinstance(known[key].kind, Paint)
        else value_from_text(name, key, text)
        for key, text in texts.items()
    }
    return make_step(name, values)


def _paint(text: str) -> ColorSpec:
    """The paint of a code, or of a specification file."""
    from paintlink.library import bundled, find, paint_spec
    from paintlink.spec import read_spec_file

    if Path(text).suffix == ".xml":
        return read_spec_file(text)
    return paint_spec(bundled(), find(bundled(), text))


def _change(file: Path, change: Callable[[Design], Design], as_json: bool) -> None:
    from paintlink.design import read_design, write_design

    design = change(read_design(file))
    write_design(file, design)
    show_design(design, as_json)
