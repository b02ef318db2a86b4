"""`paintlink previews`: a picture beside every file that is dropped into a folder."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from paintlink.model import ColorSpec
    from paintlink.preview import Picture

PAUSE_S = 0.5


@click.command("previews", short_help="Draw every file dropped into a folder.")
@click.argument("folder", type=click.Path(path_type=Path, exists=True, file_okay=False))
@click.option("--once", is_flag=True, help="Draw what is there and end.")
@click.option("--object", "object_id", default="panel", show_default=True)
@click.option("--light", default="studio", show_default=True)
@click.option("--size", default=512, show_default=True, help="Pixels, 128 to 4096.")
def command(*, folder: Path, once: bool, object_id: str, light: str, size: int) -> None:
    """Draw every specification or vendor file in FOLDER until stopped.

    NAME gets NAME.png and NAME.json beside it; the file itself is left alone.
    """
    from time import sleep

    from paintlink.intake import read_colours
    from paintlink.preview.hot_folder import HotFolder

    draw = partial(_draw, object_id, light, size)
    hot = HotFolder(folder, read_colours, draw)
    while True:
        drawn = hot.step()
        if drawn:
            made = ", ".join(drawn.pictures)
            click.echo(f"{drawn.source.name}: {drawn.error or made}")
        elif once:
            return
        else:
            sleep(PAUSE_S)


def _draw(object_id: str, light: str, size: int, spec: ColorSpec) -> Picture:
    from paintlink.cli.preview import cache_folder
    from paintlink.preview import render, with_caption

    picture = render(
        [spec], object=object_id, light=light, size=size, cache_dir=cache_folder()
    )
    return with_caption(picture)
