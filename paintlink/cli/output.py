"""How answers look: tables for people, JSON for programs."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from paintlink.model import ColorSpec, Lab, Match
    from paintlink.snap import Finding

json_option = click.option("--json", "as_json", is_flag=True, help="Print JSON.")


def print_json(document: Any) -> None:
    """Print a document as indented JSON."""
    click.echo(json.dumps(document, indent=2, ensure_ascii=False))


def print_table(
    columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = ""
) -> None:
    """Print rows under headings; columns of numbers are right-aligned."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    rows = list(rows)
    table = Table(
        title=title or None, title_justify="left", header_style="bold", box=SIMPLE_HEAD
    )
    for index, column in enumerate(columns):
        numeric = bool(rows) and all(_is_number(row[index]) for row in rows)
        table.add_column(column, justify="right" if numeric else "left")
    for row in rows:
        table.add_row(*(Text.from_ansi(cell) for cell in row))
    console = Console(soft_wrap=False)
    if not console.is_terminal:
        console = Console(width=200)
    console.print(table)


def lab_text(lab: Lab | Sequence[float]) -> str:
    """Lab with two decimals in fixed columns."""
    return " ".join(f"{value:7.2f}" for value in lab)


def number_text(value: float | None, digits: int = 1) -> str:
    """A number, or a dash where it is undefined."""
    return "-" if value is None else f"{value:.{digits}f}"


def match_document(match: Match) -> dict[str, Any]:
    """A match as a JSON document."""
    from dataclasses import asdict

    document = asdict(match)
    document["differences"] = [one._asdict() for one in match.differences]
    document["mean"] = match.mean
    return document


def findings_document(findings: Sequence[Finding]) -> list[dict[str, Any]]:
    """What was looked at in an answer, as JSON documents."""
    from dataclasses import asdict

    return [{**asdict(one), "told": one.told} for one in findings]


def spec_document(spec: ColorSpec) -> dict[str, Any]:
    """A specification as a JSON document, with its indices of travel."""
    from dataclasses import asdict

    from paintlink.color import travel
    from paintlink.spec import spec_id

    return {
        "id": spec_id(spec),
        "name": spec.name,
        "code": spec.code,
        "finish": spec.finish,
        "illuminant": "D65",
        "observer": spec.observer,
        "samples": [
            {"aspecular_deg": one.aspecular_deg, **one.lab._asdict()}
            for one in spec.samples
        ],
        "gloss": asdict(spec.gloss) if spec.gloss else None,
        "travel": asdict(travel(spec)),
    }


def _is_number(text: str) -> bool:
    try:
        float(click.unstyle(text))
    except ValueError:
        return text == "-"
    return True
