"""How a design looks on the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import (
    findings_document,
    lab_text,
    match_document,
    number_text,
    print_json,
    print_table,
    spec_document,
)

if TYPE_CHECKING:
    from paintlink.design import Design, Step
    from paintlink.model import ColorSpec, Match


def nearest_paint(spec: ColorSpec) -> Match:
    """The paint of the bundled library nearest to a specification."""
    return _nearest(spec)[0]


def _nearest(spec: ColorSpec) -> tuple[Match, ...]:
    from paintlink.library import bundled
    from paintlink.snap import nearest

    return nearest(spec, bundled())


def paint_of(match: Match, design: Design) -> ColorSpec:
    """The found paint at the angles of the design."""
    from paintlink.library import bundled, find, paint_spec

    table = bundled()
    row = find(table, match.code)
    return paint_spec(table, row, angles_deg=design.start.spec.angles_deg)


def show_design(design: Design, as_json: bool) -> None:
    """Print the start, the steps and the colour of a design."""
    document = _document(design)
    if as_json:
        print_json(document)
        return
    click.secho(design.name, bold=True)
    click.echo(f"  start: {design.start.source}")
    for number, step in enumerate(document["steps"], start=1):
        click.echo(f"  {number}. {_step_text(step)}")
    if document["undone"]:
        click.echo(f"  undone: {len(document['undone'])}")
    spec = design.spec
    columns = ("angle", "start", "design")
    rows = zip(design.start.spec.samples, spec.samples, strict=True)
    print_table(
        columns,
        [(f"{a.aspecular_deg:g}", lab_text(a.lab), lab_text(b.lab)) for a, b in rows],
    )
    _print_findings(document)


def _print_findings(document: dict[str, Any]) -> None:
    travel, nearest = document["spec"]["travel"], document["nearest"]
    click.echo(
        f"Flop Index {number_text(travel['flop_index'], 2)}, "
        f"Chroma Index {number_text(travel['chroma_index'], 2)}, "
        f"Hue Shift Index {number_text(travel['hue_shift_index'], 2)}"
    )
    rates = ", ".join(f"{name} {text}" for name, text in document["rates"].items())
    click.echo(f"travel: {rates}")
    click.echo(
        f"nearest: {nearest['code']} {nearest['name']}, "
        f"total {nearest['total']:.2f} ({nearest['words']})"
    )
    told = [one["sentence"] for one in document["findings"] if one["told"]]
    for warning in (*document["warnings"], *told):
        click.secho(f"note: {warning}", fg="yellow")


def _step_text(step: dict[str, Any]) -> str:
    values = " ".join(
        f"{name}={_value_text(value)}" for name, value in step["parameters"].items()
    )
    parts = [f"{step['step']} {values}".rstrip(), *step["notes"]]
    if step["share"] < 1.0:
        # A limited step never reads as a whole one.
        percent = min(round(100.0 * step["share"], 1), 99.9)
        parts.insert(1, f"limited to {percent:g} %")
    return "; ".join(parts)


def _value_text(value: object) -> str:
    if isinstance(value, dict):
        return str(value["code"] or value["name"])
    if isinstance(value, list):
        return ",".join(f"{number:g}" for number in value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def _document(design: Design) -> dict[str, Any]:
    from paintlink.design import color_document, rates, step_document, warnings
    from paintlink.library import bundled
    from paintlink.snap import diagnose

    matches = _nearest(design.spec)
    nearest = matches[0]
    findings = diagnose(design.spec, matches, bundled())
    return {
        "name": design.name,
        "start": {
            "source": design.start.source,
            "color": color_document(design.start.spec),
        },
        "steps": [
            step_document(made.step) | {"share": made.share, "notes": made.notes}
            for made in design.history()
        ],
        "undone": [step_document(step) for step in design.undone],
        "spec": spec_document(design.spec),
        "rates": {name: str(rate) for name, rate in rates(design.spec).items()},
        "nearest": match_document(nearest),
        "findings": findings_document(findings),
        "warnings": warnings(design.spec, nearest),
    }


def kind_document(kind: type[Step]) -> dict[str, Any]:
    """A kind of step with its parameters, limits and defaults."""
    from paintlink.design import parameters

    return {
        "step": kind.name,
        "summary": (kind.__doc__ or "").partition("\n")[0],
        "parameters": {
            name: {
                "limits": parameter.kind.words,
                "required": parameter.required,
                "default": parameter.default,
            }
            for name, parameter in parameters(kind).items()
        },
    }
