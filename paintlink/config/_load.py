"""Settings from the first configuration file that is found, or the built-in ones."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from paintlink.config._overlay import overlay
from paintlink.config._places import candidates, is_absent

if TYPE_CHECKING:
    from paintlink.config.sections.snap import SnapSettings
    from paintlink.config.settings import Settings


def load_settings(path: Path | None = None, *, environ: Mapping[str, str]) -> Settings:
    """Settings from ``path``, else from the first file found, else the built-in ones.

    Parameters
    ----------
    environ
        Names a file (``PAINTLINK_CONFIG``), the state folder (``STATE_DIRECTORY``) and
        single keys (``PAINTLINK__SECTION__KEY``).

    Raises
    ------
    ConfigError
        Naming every fault of the file and the environment, a line each.
    """
    source = path or find_config(environ)
    if source is None and not overlay(environ):
        from paintlink.config._defaults import default_settings

        return default_settings(environ=environ)
    from paintlink.config._check import checked

    return checked(source, environ=environ)


def load_snap_settings(
    path: Path | None = None, *, environ: Mapping[str, str]
) -> SnapSettings:
    """The section ``[snap]`` of `load_settings`, there much sooner when nothing is set.

    Raises
    ------
    ConfigError
        As `load_settings` does.
    """
    if path or find_config(environ) or overlay(environ):
        return load_settings(path, environ=environ).snap
    from paintlink.config.sections.snap import SnapSettings

    return SnapSettings()


def find_config(environ: Mapping[str, str]) -> Path | None:
    """The file in use when the command line names none; None when there is none."""
    named = environ.get("PAINTLINK_CONFIG")
    if named:
        return Path(named)
    return next((path for path in candidates() if not is_absent(path)), None)
