"""Names in the settings that only other parts of the program know."""

from __future__ import annotations

from collections.abc import Collection

from paintlink.config._texts import block, refusal, source_name, unknown
from paintlink.config.settings import Settings


def check_against(
    settings: Settings,
    *,
    drivers: Collection[str],
    formats: Collection[str],
    formulas: Collection[str] | None = None,
    objects: Collection[str] | None = None,
    lights: Collection[str] | None = None,
) -> None:
    """Compare the names in the settings with the known ones; None is not compared.

    Raises
    ------
    ConfigError
        Naming every unknown name, a line each.
    """
    snap, preview = settings.snap, settings.preview
    instruments = enumerate(settings.instruments)
    routes = enumerate(settings.routes)
    chosen = [
        (block("template", i, a.name), a) for i, a in enumerate(settings.templates)
    ]
    names = [
        *(
            (block("instrument", i, a.name), "driver", a.driver, drivers)
            for i, a in instruments
        ),
        *((block("route", i, a.name), "format", a.format, formats) for i, a in routes),
        *(
            (head, "routes", name, {one.name for one in settings.routes})
            for head, a in chosen
            for name in a.routes
        ),
        *(
            (head, "instruments", name, {one.name for one in settings.instruments})
            for head, a in chosen
            for name in a.instruments
        ),
        ("[snap]", "formula", snap.formula, formulas),
        ("[preview]", "object", preview.object, objects),
        ("[preview]", "light", preview.light, lights),
    ]
    source = source_name(settings.source)
    lines = [
        f"{source}: {head}: {unknown(key, name, known)}"
        for head, key, name, known in names
        if known is not None and name not in known
    ]
    if lines:
        raise refusal(lines)
