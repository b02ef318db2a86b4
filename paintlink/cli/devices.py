"""`paintlink devices`: instruments, ports, and what keeps them from working."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from paintlink.cli.output import json_option, print_json, print_table
from paintlink.cli.state import config_option, open_journal, settings_of

if TYPE_CHECKING:
    from paintlink.config import InstrumentSettings, Settings
    from paintlink.daemon.records import InstrumentStatus

WATCH_EVERY_S = 1.0
SHOWN = ("name", "driver", "port", "identity", "last_state", "text")
PORT = ("by_id", "device", "usb_id", "description", "problem")


@click.command(
    "devices", short_help="Show instruments, ports, and what is wrong with them."
)
@click.option(
    "--watch", is_flag=True, help="Show every change of an instrument until Ctrl-C."
)
@json_option
@config_option
def command(watch: bool, as_json: bool, config: Path | None) -> None:
    """Show configured instruments, ports, and the kinds paintlink knows.

    The states are what the service saw last: absent, opening, identifying, needs
    calibration, ready, reading, lost. Each has a sentence on what to do.
    """
    settings = settings_of(config)
    if watch:
        _watch(settings, config, as_json=as_json)
        return
    document = {
        "instruments": _instruments(settings, config),
        "ports": _ports(),
        "usb": _usb(),
        "kinds": _kinds(),
    }
    if as_json:
        print_json(document)
    else:
        _print(document)


def _watch(settings: Settings, config: Path | None, *, as_json: bool) -> None:
    """Print each instrument now, and again whenever something about it changes."""
    import json

    seen: dict[str, dict[str, Any]] = {}
    try:
        while True:
            for one in _instruments(settings, config):
                if seen.get(one["name"]) != one:
                    seen[one["name"]] = one
                    click.echo(json.dumps(one) if as_json else _line(one))
            time.sleep(WATCH_EVERY_S)
    except KeyboardInterrupt:
        return


def _line(one: dict[str, Any]) -> str:
    return f"{one['since'][:19]}  {one['name']}: {one['last_state']}: {one['text']}"


def _instruments(settings: Settings, config: Path | None) -> list[dict[str, Any]]:
    if not (settings.instruments and settings.journal_path.exists()):
        return [_instrument(one, None, None) for one in settings.instruments]
    with open_journal(config) as journal:
        seen = {status.name: status for status in journal.instruments()}
        return [
            _instrument(
                one,
                status := seen.get(one.name),
                status and journal.bench.last_calibration(status.identity),
            )
            for one in settings.instruments
        ]


def _instrument(
    one: InstrumentSettings, status: InstrumentStatus | None, calibrated: Any
) -> dict[str, Any]:
    return {
        "name": one.name,
        "driver": one.driver,
        "port": one.port,
        "identity": status.identity if status else "",
        "last_state": status.state if status else "never run",
        "text": status.text if status else "start the service with `paintlink run`",
        "since": status.changed_at if status else "",
        "calibrated_at": calibrated.isoformat() if calibrated else "",
    }


def _ports() -> list[dict[str, str]]:
    from dataclasses import asdict

    from paintlink.links import candidates
    from paintlink.links.modem_manager import disturbs

    ports = [asdict(port) for port in candidates()]
    for port in ports:
        port["problem"] = port["problem"] or disturbs(port["device"])
    return ports


def _usb() -> list[dict[str, str]]:
    """Instruments on USB that are no serial port; nothing where libusb is missing."""
    from dataclasses import asdict

    from paintlink.errors import LinkError
    from paintlink.instrument import drivers
    from paintlink.links.usb_devices import usb_devices

    known = {m.INFO.usb.usb_id for m in drivers().values() if m.INFO.usb}
    try:
        return [asdict(one) for one in usb_devices(known)]
    except LinkError as fault:
        return [{"address": "", "description": "", "problem": str(fault)}]


def _kinds() -> list[dict[str, Any]]:
    from paintlink.instrument import drivers, failures

    known = [
        {
            "driver": driver_id,
            "label": module.INFO.label,
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
    instruments, ports, usb, kinds = document.values()
    if instruments:
        _print_some("Configured instruments", SHOWN, instruments)
    else:
        click.echo("No instrument is configured: see `paintlink config explain`.")
    if ports:
        _print_some("Serial ports", PORT, ports)
    else:
        click.echo("No serial port found: plug the instrument or its adapter in.")
    if usb:
        _print_some("Instruments on USB", ("address", "description", "problem"), usb)
    rows = [(one["driver"], one["label"], _proof(one), one["problem"]) for one in kinds]
    print_table(("driver", "instruments", "tested on", ""), rows, title="Kinds")


def _print_some(
    title: str, columns: tuple[str, ...], documents: list[dict[str, Any]]
) -> None:
    rows = [[one[column] for column in columns] for one in documents]
    print_table(columns, rows, title=title)


def _proof(kind: dict[str, Any]) -> str:
    return "hardware" if kind["hardware_tested"] else "simulator only"
