"""`paintlink library thumbnails`: a picture of every paint."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.library_state import Where, on_shelf
from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.library.shelf import Shelf


@click.command("thumbnails")
@click.argument("folder", type=click.Path(path_type=Path, file_okay=False))
@on_shelf
@Where.options
@click.option("--object", "object_id", default="sphere", show_default=True)
@click.option("--light", default="studio", show_default=True)
@click.option("--size", default=96, show_default=True, help="Pixels, 16 to 256.")
@json_option
def thumbnails(
    folder: Path,
    shelf: Shelf,
    where: Where,
    *,
    object_id: str,
    light: str,
    size: int,
    as_json: bool,
) -> None:
    """Draw every paint of a library into FOLDER.

    What is there already and would look the same is left alone, so a command that was
    stopped goes on where it was.
    """
    from rich.console import Console
    from rich.progress import Progress

    from paintlink.cli.preview import cache_folder
    from paintlink.preview import Sheet, write_thumbnails

    sheet = Sheet(object_id, light, size, cache_folder())
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("drawing", total=None)
        written = write_thumbnails(
            folder,
            where.table(shelf),
            sheet,
            lambda done, total: bar.update(task, completed=done, total=total),
        )
    if as_json:
        print_json({"folder": str(folder), **written._asdict()})
    else:
        click.echo(f"{folder}: {written.drawn} drawn, {written.kept} there already")


COMMANDS = (thumbnails,)
