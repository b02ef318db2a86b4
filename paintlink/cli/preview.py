"""`paintlink preview`: what the paint looks like."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.model import ColorSpec
    from paintlink.preview import Picture


@click.command("preview", short_help="Draw what the paint looks like.")
@click.argument("specs", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="File to write, .png or .exr; an older picture is replaced.",
)
@click.option(
    "--object",
    "object_id",
    default="panel",
    show_default=True,
    help="bonnet, car, cylinder, panel, sphere, or a mesh file (OBJ, GLB, PLY, STL).",
)
@click.option(
    "--light",
    default="studio",
    show_default=True,
    help="booth, overcast, point, sky, studio, sunset, or a panorama (HDR, EXR).",
)
@click.option("--size", default=512, show_default=True, help="Pixels, 16 to 4096.")
@click.option(
    "--backend",
    default="auto",
    show_default=True,
    type=click.Choice(["auto", "gl", "cpu"]),
)
@click.option(
    "--pattern",
    default="columns",
    show_default=True,
    type=click.Choice(["columns", "stripes", "checker"]),
    help="How two to four paints share the object.",
)
@click.option("--turn", default=0.0, help="Turn the car or a mesh, degrees.")
@click.option("--perspective", is_flag=True, help="Near things look larger.")
@click.option(
    "--label", "labels", multiple=True, help="Role of each paint, such as 'target'."
)
@click.option(
    "--difference", is_flag=True, help="False colours of dE00 between two paints."
)
@click.option("--deep", is_flag=True, help="16 bits a colour.")
@click.option("--orange-peel", default=0.0, help="Illustration: waviness, 0 to 1.")
@click.option("--sparkle", default=0.0, help="Illustration: bright flakes, 0 to 1.")
@click.option("--graininess", default=0.0, help="Illustration: cloudiness, 0 to 1.")
@click.option("--caption/--no-caption", default=True, help="Words below the picture.")
@json_option
def command(
    *,
    specs: tuple[Path, ...],
    output: Path,
    difference: bool,
    deep: bool,
    caption: bool,
    labels: tuple[str, ...],
    as_json: bool,
    **look: Any,
) -> None:
    """Draw the colour specification SPECS; two to four share one object.

    The picture shows sRGB under a fixed exposure. It is not for visual matching.
    """
    from paintlink.cli.files import write_new
    from paintlink.preview import LEAST_WIDTH, facts, with_caption
    from paintlink.spec import read_spec_file

    paints = labelled([read_spec_file(path) for path in specs], labels)
    deep = deep or output.suffix.lower() == ".exr"
    picture = _compared(paints, look) if difference else _drawn(paints, look, deep)
    if caption and not deep and look["size"] >= LEAST_WIDTH:
        picture = with_caption(picture)
    write_new(output, _file(picture, output, deep), replace=True)
    if as_json:
        print_json({"file": str(output), **facts(picture)})
    else:
        click.echo(f"wrote {output} ({picture.backend}: {picture.reason})")


def labelled(specs: list[ColorSpec], labels: tuple[str, ...]) -> list[ColorSpec]:
    """Specifications whose names begin with their role in the comparison."""
    if len(labels) > len(specs):
        msg = f"{len(labels)} labels for {len(specs)} paints: give one --label each"
        raise click.UsageError(msg)
    roles = [*labels, *[""] * (len(specs) - len(labels))]
    return [
        replace(spec, name=f"{role}: {spec.name}" if role else spec.name)
        for spec, role in zip(specs, roles, strict=True)
    ]


def _drawn(specs: list[ColorSpec], look: dict[str, Any], deep: bool) -> Picture:
    from paintlink.preview import Illustration, render

    return render(
        specs,
        object=look["object_id"],
        light=look["light"],
        size=look["size"],
        backend=look["backend"],
        cache_dir=cache_folder(),
        pattern=look["pattern"],
        turn_deg=look["turn"],
        perspective=look["perspective"],
        illustration=Illustration(
            look["orange_peel"], look["sparkle"], look["graininess"]
        ),
        linear=deep,
    )


def _compared(specs: list[ColorSpec], look: dict[str, Any]) -> Picture:
    from paintlink.preview import difference_map

    if len(specs) != 2:
        msg = f"--difference compares two paints, not {len(specs)}"
        raise click.UsageError(msg)
    picture, _ = difference_map(
        *specs,
        object=look["object_id"],
        light=look["light"],
        size=look["size"],
        cache_dir=cache_folder(),
    )
    return picture


def _file(picture: Picture, output: Path, deep: bool) -> bytes:
    from paintlink.preview import to_exr, to_png

    if output.suffix.lower() == ".exr":
        return to_exr(picture)
    return to_png(picture, deep=deep)


def cache_folder() -> Path:
    """Where baked light is kept between calls."""
    from platformdirs import user_cache_path

    return user_cache_path("paintlink") / "baked"
