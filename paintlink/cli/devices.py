"""`paintlink devices`: instruments, ports, and what keeps them from working."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json, print_table
from paintlink.cli.state import config_option, open_journal, settings_of

if TYPE_CHECKING:
    from paintlink.config import Settings


@click.command(
    "devices", short_help="Show instruments, ports, and what is wrong with them."
)
@json_option
@config_option
def command(as_json: bool, config: Path | None) -> None:
    """Show configured instruments, serial ports, and the kinds paintlink knows."""
    settings = settings_of(config)
    document = {
        "instruments": _instruments(settings, config),
        "ports": _ports(),
        "kinds": _kinds(),
    }
    if as_json:
        print_json(document)
        return
    _print(document)


def _instruments(settings: Settings, config: Path | None) -> list[dict[str, Any]]:
    seen = {}
    if settings.instruments and settings.journal_path.exists():
        with open_journal(config) as journal:
            seen = {status.name: status for status in journal.instruments()}
    return [
        {
            "name": one.name,
            "driver": one.driver,
            "port": one.port,
            "last_state": seen[one.name].state if one.name in seen else "never run",
            "text": seen[one.name].text if one.name in seen else "",
            "since": seen[one.name].changed_at if one.name in seen else "",
        }
        for one in settings.instruments
    ]


def _ports() -> list[dict[str, str]]:
    from dataclasses import asdict

    from paintlink.links import candidates

    return [asdict(port) for port in candidates()]


def _kinds() -> list[dict[str, Any]]:
    from paintlink.instrument import drivers, failures

    known = [
        {
            "driver": driver_id,
            "label": f"{module.INFO.maker} {', '.join(module.INFO.models)}",
            "hardware_tested": module.INFO.hardware_tested,
            "problem": "",
        }
        for driver_id, module in drivers().items()
    ]
    broken = [
        {"driver": name, "label": "", "hardware_tested": False, "problem": text}
        for name, text in failures().items()
    ]
    return known + broken


def _print(document: dict[str, Any]) -> None:
    instruments, ports, kinds = document.values()
    if instruments:
        columns = ("name", "driver", "port", "last_state", "text")
        rows = [tuple(one[column] for column in columns) for one in instruments]
        print_table(columns, rows, title="Configured instruments")
    else:
        click.echo("No instrument is configured: see `paintlink config explain`.")
    if ports:
        columns = ("by_id", "device", "usb_id", "description", "problem")
        rows = [tuple(one[column] for column in columns) for one in ports]
        print_table(columns, rows, title="Serial ports")
    else:
        click.echo("No serial port found: plug the instrument or its adapter in.")
    rows = [(one["driver"], one["label"], _proof(one), one["problem"]) for one in kinds]
    print_table(("driver", "instruments", "tested on", ""), rows, title="Kinds")


def _proof(kind: dict[str, Any]) -> str:
    return "hardware" if kind["hardware_tested"] else "simulator only"
