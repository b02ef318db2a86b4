"""`paintlink sketch`: paint a colour instead of measuring it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import (
    json_option,
    lab_text,
    print_json,
    print_table,
    spec_document,
)

if TYPE_CHECKING:
    from paintlink.sketch.readback import Sketch
    from paintlink.sketch.result import SketchFit

ANGLES = {"3": (15.0, 45.0, 110.0), "5": (15.0, 25.0, 45.0, 75.0, 110.0)}


@click.group("sketch", short_help="Paint a colour in a picture, fit the paint to it.")
def command() -> None:
    """Paint a colour in any program, and get the paint that looks like it.

    `setup` writes a start picture; paint on it; `fit` reads the painting back.
    """


@command.command("setup", short_help="Write the picture to paint on.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "--to",
    "folder",
    required=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for start.png, geometry.png and recipe.json; none is replaced.",
)
@click.option("--object", "object_id", default="sphere", show_default=True)
@click.option("--size", default=1024, show_default=True, help="Pixels, 256 to 4096.")
@click.option(
    "--light",
    type=(float, float),
    metavar="POLAR AZIMUTH",
    help="Degrees off the view, and around it from the right (135: upper left); "
    "left out, what suits the object.",
)
@click.option(
    "--near",
    type=float,
    metavar="DISTANCE",
    help="A point light at this many half widths of the object, at least 2.",
)
@click.option("--bits", default="8", show_default=True, type=click.Choice(["8", "16"]))
def setup(
    *,
    spec: Path,
    folder: Path,
    object_id: str,
    size: int,
    light: tuple[float, float] | None,
    near: float | None,
    bits: str,
) -> None:
    """Write a picture of the colour specification SPEC to paint on."""
    from paintlink.sketch.pose import Pose, light_for
    from paintlink.sketch.setup import save, set_up
    from paintlink.spec import read_spec_file

    pose = Pose(object_id, light_for(object_id, light, near), size)
    made = set_up(read_spec_file(spec), pose, bits=int(bits))
    save(made, folder)
    for warning in made.warnings:
        click.secho(f"warning: {warning}", err=True, fg="yellow")
    click.echo(f"paint on {folder / 'start.png'}, keep {folder / 'recipe.json'}")


@command.command("fit", short_help="Fit a paint to the painted picture.")
@click.argument("painted", type=click.Path(path_type=Path, dir_okay=False))
@click.option(
    "--recipe",
    "recipe_path",
    type=click.Path(path_type=Path, dir_okay=False),
    help="recipe.json of the set-up; left out, the one beside the picture.",
)
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="Colour specification to write, refused when it exists.",
)
@click.option("--angles", default="5", show_default=True, type=click.Choice([*ANGLES]))
@click.option(
    "--report",
    type=click.Path(path_type=Path, dir_okay=False),
    help="PNG file with the painting, the fitted paint and where they differ.",
)
@click.option("--name", default="", help="Name of the colour; else that of the file.")
@json_option
def fit(
    *,
    painted: Path,
    recipe_path: Path | None,
    output: Path,
    angles: str,
    report: Path | None,
    name: str,
    as_json: bool,
) -> None:
    """Fit a paint to PAINTED, the start picture as you changed it."""
    from paintlink.cli.files import write_new
    from paintlink.sketch.fit import fit_painting
    from paintlink.sketch.readback import read_back
    from paintlink.sketch.recipe_file import read_recipe_file
    from paintlink.spec import write_spec

    recipe_path = recipe_path or painted.with_name("recipe.json")
    sketch = read_back(painted, read_recipe_file(recipe_path))
    found = fit_painting(
        sketch.painting,
        sketch.geometry,
        sketch.start,
        exposure=sketch.recipe.exposure,
        angles_deg=ANGLES[angles],
        name=name or painted.stem,
    )
    if report is not None:
        write_new(report, _picture(sketch, found), replace=True)
    write_new(output, write_spec(found.spec()))
    notes = [*sketch.painting.notes, *_altered(recipe_path, sketch), *found.notes]
    if as_json:
        print_json(_document(found, notes))
    else:
        _print(found, notes, output)


def _picture(sketch: Sketch, found: SketchFit) -> bytes:
    from paintlink.sketch.png import to_png
    from paintlink.sketch.report import report_picture

    exposure = sketch.recipe.exposure
    drawn = report_picture(found, sketch.painting, sketch.geometry, exposure)
    return to_png(drawn, found.name, srgb=True)


def _altered(recipe_path: Path, sketch: Sketch) -> list[str]:
    """What is wrong with the geometry picture beside the recipe, if there is one."""
    from paintlink.sketch.readback import altered_geometry
    from paintlink.sketch.setup import GEOMETRY

    beside = recipe_path.with_name(GEOMETRY)
    words = altered_geometry(beside, sketch.recipe) if beside.exists() else ""
    return [words] if words else []


def _document(found: SketchFit, notes: list[str]) -> dict[str, Any]:
    return {
        "specification": spec_document(found.spec()),
        "angles": [
            {
                "aspecular_deg": one.evidence.aspecular_deg,
                "state": one.evidence.word,
                "pixels": one.evidence.pixels,
                "uncertainty": list(one.uncertainty),
            }
            for one in found.angles
        ],
        "pixels": dict(found.counts),
        "notes": notes,
    }


def _print(found: SketchFit, notes: list[str], output: Path) -> None:
    rows = [
        (
            f"{one.evidence.aspecular_deg:g}",
            lab_text(one.lab),
            lab_text(one.uncertainty),
            one.evidence.word,
            str(one.evidence.pixels),
        )
        for one in found.angles
    ]
    headings = ("angle", "Lab D65/10", "uncertain by", "state", "pixels")
    print_table(headings, rows, title=f"Paint read out of {found.name!r}")
    for note in notes:
        click.echo(f"note: {note}", err=True)
    click.echo(f"wrote {output}")
