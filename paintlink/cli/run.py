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
    from paintlink.daemon.checks import check_names, folder_problems
    from paintlink.daemon.notify import Notifier
    from paintlink.daemon.service import Service

    settings = settings_of(config)
    set_up_logging(settings.log.level)
    check_names(settings)
    for problem in folder_problems(settings):
        click.secho(problem, err=True, fg="yellow")
    stop = stop_on_signals()
    service = Service(settings, roles=roles or ROLES)
    service.start()
    names = ", ".join(one.name for one in settings.instruments) or "no instrument"
    notifier = Notifier(os.environ)
    notifier.ready(f"{names}; {len(settings.routes)} routes")
    inbox = settings.inbox.folder if settings.inbox.enabled else "off"
    click.echo(f"paintlink runs: {names}; inbox {inbox}; stop with Ctrl-C", err=True)
    try:
        serve(service, notifier, stop)
    finally:
        notifier.stopping()
        service.stop()


def stop_on_signals() -> threading.Event:
    """An event that Ctrl-C and SIGTERM set, in place of ending the process."""
    stop = threading.Event()

    def on_signal(number: int, frame: FrameType | None) -> None:
        del number, frame
        stop.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, on_signal)
    return stop


def serve(service: Service, notifier: Notifier, stop: threading.Event) -> None:
    """Feed the watchdog while the workers make progress, until told to stop.

    Raises
    ------
    JournalError
        When the service ended by itself.
    """
    from paintlink.errors import JournalError

    while not stop.wait(1.0):
        if service.stopped.is_set():
            msg = "stopped, because the journal can no longer be trusted: see the log"
            raise JournalError(msg)
        if service.makes_progress():
            notifier.watchdog()
