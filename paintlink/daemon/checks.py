"""What must be true of the settings before the service starts."""

from __future__ import annotations

from paintlink.color import FORMULAS
from paintlink.config import Settings, check_against
from paintlink.export import load_formats, probe
from paintlink.instrument import drivers
from paintlink.preview import light_names, object_names


def check_names(settings: Settings) -> None:
    """Refuse settings that name unknown drivers, formats, formulas or pictures.

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


def folder_problems(settings: Settings) -> list[str]:
    """A sentence for each route folder that cannot be written to now.

    The service starts all the same: a share may come back, and until then its files
    wait in the journal.
    """
    return [
        f"[[route]] {route.name!r} folder: {problem}"
        for route in settings.routes
        if route.enabled and (problem := probe(route.folder))
    ]
