"""`paintlink convert`: a specification in another format."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("convert", short_help="Convert a specification to another format.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "--to",
    "format_id",
    default="xml",
    show_default=True,
    help="xml (canonical form), cxf3, csv, json, colornet, or a format of the site.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path, dir_okay=False),
    help="File to write, refused when it exists; standard output when left out.",
)
def command(spec: Path, format_id: str, output: Path | None) -> None:
    """Convert the colour specification SPEC to another format."""
    from paintlink.spec import read_spec_file, write_spec

    target = read_spec_file(spec)
    if format_id == "xml":
        data = write_spec(target)
    else:
        from paintlink.cli.render import rendered

        data = rendered(target, format_id).data
    if output is None:
        click.echo(data, nl=False)
        return
    from paintlink.cli.files import write_new

    write_new(output, data)
    click.echo(f"wrote {output}", err=True)
