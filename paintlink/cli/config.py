"""`paintlink config`: check and explain the configuration."""

from __future__ import annotations

from pathlib import Path

import click

from paintlink.cli.state import config_option, settings_of


@click.group("config")
def command() -> None:
    """Check the configuration, or explain every key."""


@command.command("check")
@config_option
def check(config: Path | None) -> None:
    """Check the configuration and the folders it names; every fault is listed."""
    from paintlink.daemon.checks import check_names, folder_problems
    from paintlink.errors import ConfigError

    settings = settings_of(config)
    check_names(settings)
    problems = folder_problems(settings)
    if problems:
        raise ConfigError("\n".join(problems))
    source = settings.source or "built-in defaults (no configuration file found)"
    click.echo(f"{source}: {len(settings.instruments)} instruments, ", nl=False)
    click.echo(f"{len(settings.routes)} routes, no fault found")


@command.command("explain")
def explain() -> None:
    """Print every key with its default and its meaning."""
    from paintlink.config import explain as explanation

    click.echo(explanation())
