"""`paintlink snap`: the nearest known paints."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.output import json_option, match_document, print_json, print_table

if TYPE_CHECKING:
    from paintlink.config import SnapSettings
    from paintlink.model import ColorSpec, Finish, Match

BAND_COLORS = {"green": "green", "amber": "yellow", "red": "red"}


@click.command("snap", short_help="Find the nearest known paints.")
@click.argument("spec", type=click.Path(path_type=Path))
@click.option("-k", "--top", default=5, show_default=True, help="How many paints.")
@click.option(
    "-m",
    "--metric",
    default="cie76",
    show_default=True,
    help="Difference formula: cie76 (the paper's), ciede2000, cie94, cmc, din99.",
)
@click.option(
    "--finish",
    "finishes",
    multiple=True,
    type=click.Choice(["solid", "metallic", "pearl"]),
    help="Only paints of this finish; may be repeated.",
)
@json_option
def command(
    spec: Path, top: int, metric: str, finishes: tuple[Finish, ...], as_json: bool
) -> None:
    """Find the known paints nearest to the colour specification SPEC.

    Ranked by the sum of the colour differences at the aspecular angles 15, 45 and 110
    degrees; ties go to the smaller paint id. Differences are target minus paint:
    "face 1.2 lighter" means that the target is lighter than the paint.
    """
    from paintlink.library import Filter, bundled
    from paintlink.snap import nearest
    from paintlink.spec import read_spec_file

    target = read_spec_file(spec)
    table = bundled()
    mask = Filter(finishes=finishes).apply(table) if finishes else None
    matches = nearest(target, table, top=top, formula=metric, mask=mask)
    if as_json:
        print_json([match_document(match) for match in matches])
        return
    print_matches(target, matches)


def print_matches(
    target: ColorSpec, matches: tuple[Match, ...], limits: SnapSettings | None = None
) -> None:
    """Print a ranked list with its conditions, each code in its traffic light."""
    from paintlink.config import SnapSettings
    from paintlink.snap import band

    limits = limits or SnapSettings()

    def _color(match: Match) -> str:
        colour = band(match, green_up_to=limits.green, amber_up_to=limits.amber)
        return BAND_COLORS[colour]

    best = matches[0]
    angles = [f"{angle:g}" for angle in best.angles_deg]
    rows = [
        (
            str(match.rank),
            click.style(match.code, fg=_color(match), bold=True),
            match.name,
            match.finish,
            f"{match.total:.2f}",
            *(f"{one.dE:.2f}" for one in match.differences),
            match.words,
        )
        for match in matches
    ]
    headings = [f"at {angle}" for angle in angles]
    print_table(
        ("rank", "code", "name", "finish", "total", *headings, "in words"),
        rows,
        title=f"Starting points for {target.name!r}",
    )
    click.echo(
        f"{best.formula}, sum over {'/'.join(angles)} degrees, D65/{best.observer}, "
        f"{best.library}, generation {best.generation}"
    )
