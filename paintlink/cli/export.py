"""`paintlink export`: a file for another program, placed in its folder."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.output import json_option, print_json


@click.command("export", short_help="Deliver a specification into a watched folder.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "--format",
    "format_id",
    default="colornet",
    show_default=True,
    help="Export format: colornet, cxf3, csv, json, or a format of the site.",
)
@click.option(
    "--to",
    "folder",
    required=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder the other program watches.",
)
@json_option
def command(spec: Path, format_id: str, folder: Path, as_json: bool) -> None:
    """Deliver the colour specification SPEC into a folder, whole or not at all.

    A format that needs a starting paint gets the nearest one of the bundled library
    when the specification names none. A file that exists is never overwritten.
    """
    from paintlink.cli.render import rendered
    from paintlink.errors import ExportError
    from paintlink.export import discard, publish, stage
    from paintlink.spec import read_spec_file

    file = rendered(read_spec_file(spec), format_id)
    token = f"export-{file.sha256[:16]}"
    stage(folder, token, file.data)
    try:
        path = publish(folder, token, file.name)
    except ExportError:
        discard(folder, token)
        raise
    if as_json:
        print_json({"file": str(path), "format": format_id, "sha256": file.sha256})
    else:
        click.echo(f"delivered {path}")
