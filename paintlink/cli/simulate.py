"""`paintlink simulate`: a simulated instrument to talk to."""

from __future__ import annotations

import runpy
import sys

import click


@click.command(
    "simulate",
    add_help_option=False,
    context_settings={"ignore_unknown_options": True, "allow_extra_args": True},
)
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED)
def command(arguments: tuple[str, ...]) -> None:
    """Simulate an instrument at a pseudo-terminal or a TCP port.

    For example `paintlink simulate xrite_ma --pty`; `--help` shows all options.
    """
    sys.argv = ["paintlink simulate", *arguments]
    runpy.run_module("paintlink_simulators", run_name="__main__", alter_sys=False)
