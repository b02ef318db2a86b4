"""`paintlink validate`: say whether a file is a colour specification."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from paintlink.cli.output import json_option, print_json
from paintlink.errors import SpecError


@click.command("validate")
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))
@json_option
def command(files: tuple[Path, ...], as_json: bool) -> None:
    """Check colour specification files.

    Prints one line for each FILE: its identity and angles, or what is wrong, where,
    and what to do. Exits with 3 when one cannot be used.
    """
    results = [_check(path) for path in files]
    if as_json:
        print_json(results)
    else:
        for result in results:
            if result["valid"]:
                angles = "/".join(f"{angle:g}" for angle in result["angles_deg"])
                text = f"{result['file']}: valid, {result['name']!r}, {angles} degrees"
                click.echo(f"{text}, id {result['id'][:12]}")
            else:
                click.secho(result["error"], fg="red", err=True)
    if not all(result["valid"] for result in results):
        raise SystemExit(SpecError.exit_code)


def _check(path: Path) -> dict[str, Any]:
    from paintlink.spec import read_spec_file, spec_id

    try:
        spec = read_spec_file(path)
    except SpecError as error:
        return {"file": str(path), "valid": False, "error": str(error)}
    return {
        "file": str(path),
        "valid": True,
        "id": spec_id(spec),
        "name": spec.name,
        "angles_deg": spec.angles_deg,
    }
