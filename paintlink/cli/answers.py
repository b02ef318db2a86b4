"""How the answer of ColorSnap looks: table, document, graph."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import findings_document, match_document, print_table

if TYPE_CHECKING:
    from paintlink.config import SnapSettings
    from paintlink.model import ColorSpec, Match, PaintTable
    from paintlink.snap import Answer, Forecast

BAND_COLORS = {"green": "green", "amber": "yellow", "red": "red"}
GRAPH_MATCHES = 10


def print_answer(
    spec: ColorSpec, found: Answer, limits: SnapSettings | None = None
) -> None:
    """Print the list, how sure its first rank is, and what is wrong with it."""
    second = (found.second_formula, found.second_ranks)
    print_matches(spec, found.matches, limits, second)
    related = [
        f"{name} {match.code}"
        for name, match in found.relations.items()
        if name != "closest"
    ]
    if related:
        click.echo(f"nearest that is: {', '.join(related)}")
    for ranks in found.variants:
        click.echo(f"variants of one paint: ranks {', '.join(map(str, ranks))}")
    sure = found.confidence
    margin = "" if sure.margin is None else f", {sure.margin:.2f} ahead of the second"
    click.echo(
        f"{found.matches[0].code} stays first in {sure.stays_first:.0%} of readings "
        f"repeated within ΔE {sure.repeatability:g}{margin}"
    )
    from paintlink.snap import sentences

    for sentence in sentences(found.findings):
        click.secho(f"! {sentence}", fg="yellow")
    if found.forecast is not None:
        color = "green" if found.forecast.likely else "yellow"
        click.secho(found.forecast.sentence, fg=color)


def print_matches(
    target: ColorSpec,
    matches: tuple[Match, ...],
    limits: SnapSettings | None = None,
    second: tuple[str, tuple[int | None, ...]] | None = None,
) -> None:
    """Print a ranked list with its conditions, each code in its traffic light."""
    from paintlink.snap import band
    from paintlink.snap.verdict import AMBER_UP_TO, GREEN_UP_TO

    green = limits.green if limits else GREEN_UP_TO
    amber = limits.amber if limits else AMBER_UP_TO

    def _color(match: Match) -> str:
        return BAND_COLORS[band(match, green_up_to=green, amber_up_to=amber)]

    best = matches[0]
    angles = [f"{angle:g}" for angle in best.angles_deg]
    ranks = second[1] if second else (None,) * len(matches)
    books = {f"{m.library}, generation {m.generation}": None for m in matches}
    several = len(books) > 1
    rows = [
        (
            str(match.rank),
            click.style(match.code, fg=_color(match), bold=True),
            match.name,
            match.finish,
            *([match.library] if several else []),
            f"{match.total:.2f}",
            *(f"{one.dE:.2f}" for one in match.differences),
            *(["-" if rank is None else str(rank)] if second else []),
            match.words,
        )
        for match, rank in zip(matches, ranks, strict=True)
    ]
    headings = [f"at {angle}" for angle in angles]
    beside = [f"by {second[0]}"] if second else []
    book = ["library"] if several else []
    about = ("rank", "code", "name", "finish", *book, "total")
    print_table(
        (*about, *headings, *beside, "in words"),
        rows,
        title=f"Starting points for {target.name!r}",
    )
    click.echo(
        f"{best.formula}, sum over {'/'.join(angles)} degrees, D65/{best.observer}, "
        f"{'; '.join(books)}"
    )
    if best.estimated_deg:
        estimated = "/".join(f"{angle:g}" for angle in best.estimated_deg)
        click.echo(f"estimated: the library is interpolated at {estimated} degrees")


def answer_document(found: Answer) -> dict[str, Any]:
    """An answer as a JSON document."""
    from dataclasses import asdict

    return {
        "matches": [
            {**match_document(match), "second_rank": rank}
            for match, rank in zip(found.matches, found.second_ranks, strict=True)
        ],
        "second_formula": found.second_formula,
        "relations": {name: m.code for name, m in found.relations.items()},
        "variants": found.variants,
        "confidence": asdict(found.confidence),
        "findings": findings_document(found.findings),
        "forecast": _forecast_document(found.forecast),
    }


def _forecast_document(forecast: Forecast | None) -> dict[str, Any] | None:
    if forecast is None:
        return None
    return {
        "chance": forecast.chance,
        "suggestion": forecast.suggestion.tolist(),
        "away": forecast.away,
    }


def write_graph(
    path: Path, spec: ColorSpec, matches: tuple[Match, ...], table: PaintTable
) -> None:
    """Write the 3D graph as a picture, or as a document for plotly."""
    from paintlink.cli.files import write_new
    from paintlink.snap.graph import graph, plotly

    suffix = path.suffix.lower()
    drawn = graph(spec, matches[:GRAPH_MATCHES], table)
    if suffix == ".json":
        import json

        data = json.dumps(plotly(drawn), allow_nan=False).encode()
    elif suffix in {".png", ".svg"}:
        from paintlink.snap.picture import picture

        data = picture(drawn, format="png" if suffix == ".png" else "svg")
    else:
        msg = f"{path}: the graph is PNG, SVG or JSON: end the name in .png"
        raise click.UsageError(msg)
    write_new(path, data, replace=True)
    click.echo(f"wrote {path}", err=True)
