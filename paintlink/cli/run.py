"""`paintlink run`: the service."""

from __future__ import annotations

import os
import signal
import threading
from pathlib import Path
from typing import TYPE_CHECKING

import click

from paintlink.cli.state import config_option, settings_of
from paintlink.daemon.roles import ROLES, Role

if TYPE_CHECKING:
    from types import FrameType

    from paintlink.daemon.notify import Notifier
    from paintlink.daemon.service import Service


@click.command("run")
@click.option(
    "--role",
    "roles",
    multiple=True,
    type=click.Choice(ROLES),
    help="Run only this part; may be repeated. All of them when left out.",
)
@config_option
def command(roles: tuple[Role, ...], config: Path | None) -> None:
    """Run the service: instruments, inbox, line and pictures.

    Ends on Ctrl-C or SIGTERM; what is not finished goes on at the next start.
    """
    from paintlink.cli.log import set_up_logging
    from paintlink.daemon.checks import check_settings
    from paintlink.daemon.notify import Notifier
    from paintlink.daemon.service import Service

    settings = settings_of(config)
    set_up_logging(settings.log.level)
    check_settings(settings)
    service = Service(settings, roles=roles or ROLES)
    service.start()
    names = ", ".join(one.name for one in settings.instruments) or "no instrument"
    notifier = Notifier(os.environ)
    notifier.ready(f"{names}; {len(settings.routes)} routes")
    click.echo(f"paintlink runs: {names}; stop with Ctrl-C", err=True)
    try:
        serve(service, notifier)
    finally:
        notifier.stopping()
        service.stop()


def serve(service: Service, notifier: Notifier) -> None:
    """Feed the watchdog while the workers make progress, until a signal ends it."""
    stop = threading.Event()

    def on_signal(number: int, frame: FrameType | None) -> None:
        del number, frame
        stop.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, on_signal)
    while not stop.wait(1.0) and not service.stopped.is_set():
        if service.makes_progress():
            notifier.watchdog()
