"""What must be true of the settings before the service starts."""

from __future__ import annotations

from paintlink.color import FORMULAS
from paintlink.config import Settings, check_against
from paintlink.errors import ConfigError
from paintlink.export import load_formats, probe
from paintlink.instrument import drivers
from paintlink.preview import light_names, object_names


def check_settings(settings: Settings) -> None:
    """Refuse settings that name unknown parts or folders that cannot be used.

    Raises
    ------
    ConfigError
        Naming every fault at once.
    """
    formats = load_formats(settings.formats_folder)
    check_against(
        settings,
        drivers=drivers(),
        formats=formats,
        formulas=FORMULAS,
        objects=object_names(),
        lights=light_names(),
    )
    faults = [
        f"[[route]] {route.name!r} folder: {problem}"
        for route in settings.routes
        if route.enabled and (problem := probe(route.folder))
    ]
    if faults:
        raise ConfigError("\n".join(faults))
