"""`paintlink preview`: what the paint looks like."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from paintlink.preview.picture import Backend


@click.command("preview", short_help="Draw what the paint looks like.")
@click.argument("specs", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="PNG file to write; an older picture is replaced.",
)
@click.option("--object", "object_id", default="panel", show_default=True)
@click.option("--light", default="studio", show_default=True)
@click.option("--size", default=512, show_default=True, help="Pixels, 16 to 4096.")
@click.option(
    "--backend",
    default="auto",
    show_default=True,
    type=click.Choice(["auto", "gl", "cpu"]),
)
@click.option("--caption/--no-caption", default=True, help="Words below the picture.")
def command(
    *,
    specs: tuple[Path, ...],
    output: Path,
    object_id: str,
    light: str,
    size: int,
    backend: Backend,
    caption: bool,
) -> None:
    """Draw the colour specification SPECS; two to four stand side by side.

    The picture shows sRGB under a fixed exposure. It is not for visual matching.
    """
    from paintlink.cli.files import write_new
    from paintlink.preview import LEAST_WIDTH, render, to_png, with_caption
    from paintlink.spec import read_spec_file

    picture = render(
        [read_spec_file(path) for path in specs],
        object=object_id,
        light=light,
        size=size,
        backend=backend,
        cache_dir=cache_folder(),
    )
    if caption and size >= LEAST_WIDTH:
        picture = with_caption(picture)
    write_new(output, to_png(picture), replace=True)
    click.echo(f"wrote {output} ({picture.backend}: {picture.reason})")


def cache_folder() -> Path:
    """Where baked light is kept between calls."""
    from platformdirs import user_cache_path

    return user_cache_path("paintlink") / "baked"
