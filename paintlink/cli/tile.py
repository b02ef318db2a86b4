"""`paintlink tile`: how an instrument sees its check tile, then and now."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.operator import Operator
from paintlink.cli.output import json_option, print_json, print_table
from paintlink.cli.state import (
    config_option,
    find_instrument,
    open_journal,
    settings_of,
)

if TYPE_CHECKING:
    from paintlink.daemon.bench import TileCheck


@click.group("tile", short_help="Watch the drift of an instrument on a check tile.")
def command() -> None:
    """Read a check tile from time to time, and see the instrument drift.

    The first reading of a tile is what the later ones are compared with: take it when
    the instrument is new or comes back from service.
    """


@command.command("check")
@click.argument("device")
@click.argument("tile")
@click.option("--driver", help="Kind of instrument, when DEVICE is a port.")
@json_option
@config_option
def check(
    *, device: str, tile: str, driver: str | None, as_json: bool, config: Path | None
) -> None:
    """Read the check tile TILE (your name for it) with DEVICE and keep the result.

    A difference of 0.5 is a warning, 1.0 an alarm (CIE76, largest angle).
    """
    from paintlink.daemon.journal import Journal
    from paintlink.daemon.taking import at_hand, check_tile

    settings = settings_of(config)
    instrument = find_instrument(settings, device, driver)
    with (
        Journal(settings.journal_path) as journal,
        at_hand(settings, instrument) as session,
    ):
        found = check_tile(journal, instrument, session, tile=tile, operator=Operator())
    _print((found,), as_json=as_json)


@command.command("log")
@click.argument("instrument")
@click.option("--tile", default="", help="Of this tile only.")
@json_option
@config_option
def log(*, instrument: str, tile: str, as_json: bool, config: Path | None) -> None:
    """Show the readings of check tiles by INSTRUMENT.

    INSTRUMENT is its name, or what `paintlink devices` shows as its identity.
    """
    with open_journal(config) as journal:
        known = {one.name: one.identity for one in journal.instruments()}
        identity = known.get(instrument, instrument)
        checks = journal.bench.tile_checks(identity, tile)
    _print(checks, as_json=as_json)


def _print(checks: tuple[TileCheck, ...], *, as_json: bool) -> None:
    documents = [_document(one) for one in checks]
    if as_json:
        print_json(documents)
        return
    rows = [
        (
            one["at"],
            one["tile"],
            "  ".join(f"{angle:g}: {dE:.2f}" for angle, dE in one["drift"].items()),
            one["verdict"],
        )
        for one in documents
    ]
    print_table(("at", "tile", "drift in dE by angle", "verdict"), rows)


def _document(check: TileCheck) -> dict[str, Any]:
    return {
        "at": check.at.isoformat(timespec="seconds"),
        "tile": check.tile,
        "lab": {
            angle: list(lab)
            for angle, lab in zip(check.angles_deg, check.lab, strict=True)
        },
        "drift": dict(check.drift),
        "verdict": check.verdict,
    }
