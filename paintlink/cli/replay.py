"""`paintlink replay`: a captured session with an instrument, read once more."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json

if TYPE_CHECKING:
    from paintlink.links import Outcome
    from paintlink.model import Measurement


@click.command("replay", short_help="Read a captured session once more.")
@click.argument("capture", type=click.Path(path_type=Path, dir_okay=False, exists=True))
@json_option
def command(capture: Path, as_json: bool) -> None:
    """Give the bytes of CAPTURE to its driver and show what comes out.

    The service keeps a capture of every session in captures/ of its state folder.
    The same bytes give the same readings, bit for bit.
    """
    from paintlink.instrument import load_driver
    from paintlink.links import read_capture, replay

    captured = read_capture(capture)
    outcomes = list(replay(captured, load_driver(captured.driver)))
    if as_json:
        print_json([_document(one) for one in outcomes])
        return
    click.echo(f"{captured.driver}, captured {captured.started_at.isoformat()}")
    for outcome in outcomes:
        click.echo(f"{outcome.verb}: {_summary(outcome)}")


def _document(outcome: Outcome) -> dict[str, Any]:
    from dataclasses import asdict

    from paintlink.model import Instrument, Measurement

    value: Any = outcome.value
    if isinstance(value, Measurement):
        value = _measurement(value)
    elif isinstance(value, tuple):
        value = [_measurement(one) for one in value]
    elif isinstance(value, Instrument):
        value = asdict(value)
    error = None if outcome.error is None else str(outcome.error)
    return {"call": outcome.verb, "value": value, "error": error}


def _measurement(measurement: Measurement) -> dict[str, Any]:
    spectra, lab = measurement.spectra, measurement.lab
    return {
        "geometries": [geometry.code for geometry in measurement.geometries],
        "wavelengths_nm": spectra.wavelengths_nm.tolist() if spectra else None,
        "factors": spectra.factors.tolist() if spectra else None,
        "lab": lab.lab.tolist() if lab else None,
        "raw_bytes": len(measurement.raw),
    }


def _summary(outcome: Outcome) -> str:
    from paintlink.model import Instrument, Measurement

    if outcome.error is not None:
        return f"refused: {outcome.error}"
    if isinstance(outcome.value, Measurement):
        codes = ", ".join(one.code for one in outcome.value.geometries)
        return f"{codes}, {len(outcome.value.raw)} bytes"
    if isinstance(outcome.value, Instrument):
        return f"{outcome.value.maker} {outcome.value.model} {outcome.value.firmware}"
    if isinstance(outcome.value, tuple):
        return f"{len(outcome.value)} stored readings"
    return outcome.value or "done"
