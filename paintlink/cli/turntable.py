"""`paintlink turntable`: the paint on an object that turns."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@click.command("turntable", short_help="Draw the paint on an object that turns.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path),
    help="Animated .webp file, or a folder for single pictures.",
)
@click.option(
    "--object", "object_id", default="car", show_default=True, help="Car or mesh file."
)
@click.option("--light", default="studio", show_default=True)
@click.option("--size", default=512, show_default=True, help="Pixels, 16 to 1024.")
@click.option("--frames", default=72, show_default=True, help="Pictures in a turn.")
@click.option("--seconds", default=6.0, show_default=True, help="Length of a turn.")
def command(
    *,
    spec: Path,
    output: Path,
    object_id: str,
    light: str,
    size: int,
    frames: int,
    seconds: float,
) -> None:
    """Draw a full turn of the paint SPEC.

    Light and viewer stand still, so that face and flop wander over the object.
    """
    from rich.console import Console
    from rich.progress import track

    from paintlink.cli.files import write_new
    from paintlink.cli.preview import cache_folder
    from paintlink.preview import Turntable, to_webp, turn
    from paintlink.spec import read_spec_file

    table = Turntable(object_id, light, size, frames, cache_folder())
    pictures = turn(read_spec_file(spec), table)
    drawn = list(
        track(
            pictures,
            "turning",
            total=frames,
            console=Console(stderr=True),
            transient=True,
        )
    )
    if output.suffix.lower() == ".webp":
        write_new(output, to_webp(drawn, seconds=seconds), replace=True)
    else:
        _write_frames(output, drawn)
    click.echo(f"wrote {output} ({frames} pictures)")


def _write_frames(folder: Path, pictures: list[NDArray[np.uint8]]) -> None:
    from paintlink.preview.picture import WARNING
    from paintlink.preview.png import encoded

    folder.mkdir(parents=True, exist_ok=True)
    for number, picture in enumerate(pictures):
        data = encoded(picture, [("Comment", WARNING)])
        (folder / f"{number:03d}.png").write_bytes(data)
