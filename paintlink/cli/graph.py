"""`paintlink graph`: a target among the known paints, in Lab space."""

from __future__ import annotations

from pathlib import Path

import click


@click.command("graph", short_help="Draw a target among the known paints.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    required=True,
    type=click.Path(path_type=Path, dir_okay=False),
    help="Picture (.png, .svg) or plotly document (.json); an older one is replaced.",
)
@click.option("-k", "--top", default=10, show_default=True, help="Nearest paints.")
@click.option(
    "-m", "--metric", default="cie76", show_default=True, help="Difference formula."
)
def command(spec: Path, output: Path, top: int, metric: str) -> None:
    """Draw the colour specification SPEC, its nearest paints and the whole library.

    Every colour is drawn in its own colour and with its way from face to flop, so that
    a design which no paint comes near stands out. Pictures need matplotlib: pip install
    'paintlink[plots]'.
    """
    from paintlink.cli.answers import write_graph
    from paintlink.library import bundled
    from paintlink.snap import nearest
    from paintlink.spec import read_spec_file

    target, table = read_spec_file(spec), bundled()
    write_graph(output, target, nearest(target, table, top=top, formula=metric), table)
