"""Configuration and journal as the commands open them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from paintlink.config import InstrumentSettings, Settings
    from paintlink.daemon.journal import Journal

config_option = click.option(
    "--config",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Configuration file; see `paintlink config explain`.",
)


def settings_of(config: Path | None) -> Settings:
    """The settings of a file, or of the first file found in the usual places."""
    from paintlink.config import load_settings

    return load_settings(config, environ=os.environ)


def open_journal(config: Path | None) -> Journal:
    """The journal of the configured state folder."""
    from paintlink.daemon.journal import Journal

    return Journal(settings_of(config).journal_path)


def find_instrument(
    settings: Settings, device: str, driver: str | None
) -> InstrumentSettings:
    """The configured instrument of a name, or one on a port with the given driver.

    Raises
    ------
    ConfigError
        When the name is unknown, or a port comes without a driver.
    """
    from paintlink.config import InstrumentSettings
    from paintlink.errors import ConfigError

    known = {one.name: one for one in settings.instruments}
    if device in known:
        return known[device]
    if driver is not None:
        return InstrumentSettings(name=device, driver=driver, port=device, readings=1)
    if "/" in device:
        msg = f"{device} is a port: say what is plugged in, such as --driver xrite_ma"
        raise ConfigError(msg)
    names = ", ".join(known) or "none yet"
    msg = (
        f"no instrument {device!r} is configured (configured: {names}): add it as "
        "`paintlink config explain` shows, or name a port with --driver"
    )
    raise ConfigError(msg)
