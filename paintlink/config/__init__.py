"""What the service is told: one TOML file, checked as a whole, as frozen settings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from paintlink.late import late

if TYPE_CHECKING:
    from paintlink.config._defaults import default_settings
    from paintlink.config._explain import explain
    from paintlink.config._known import check_against
    from paintlink.config._load import find_config, load_settings, load_snap_settings
    from paintlink.config.sections.formulation import FormulationSettings
    from paintlink.config.sections.inbox import InboxSettings
    from paintlink.config.sections.instrument import InstrumentSettings
    from paintlink.config.sections.preview import PreviewSettings
    from paintlink.config.sections.routes import (
        RouteSettings,
        SinkSettings,
        TemplateSettings,
    )
    from paintlink.config.sections.site import LogSettings, SiteSettings, StateSettings
    from paintlink.config.sections.snap import SnapSettings
    from paintlink.config.settings import Settings

__all__ = [
    "FormulationSettings",
    "InboxSettings",
    "InstrumentSettings",
    "LogSettings",
    "PreviewSettings",
    "RouteSettings",
    "Settings",
    "SinkSettings",
    "SiteSettings",
    "SnapSettings",
    "StateSettings",
    "TemplateSettings",
    "check_against",
    "default_settings",
    "explain",
    "find_config",
    "load_settings",
    "load_snap_settings",
]

_HOMES = {
    "FormulationSettings": "sections.formulation",
    "InboxSettings": "sections.inbox",
    "InstrumentSettings": "sections.instrument",
    "LogSettings": "sections.site",
    "PreviewSettings": "sections.preview",
    "RouteSettings": "sections.routes",
    "Settings": "settings",
    "SinkSettings": "sections.routes",
    "SiteSettings": "sections.site",
    "SnapSettings": "sections.snap",
    "StateSettings": "sections.site",
    "TemplateSettings": "sections.routes",
    "check_against": "_known",
    "default_settings": "_defaults",
    "explain": "_explain",
    "find_config": "_load",
    "load_settings": "_load",
    "load_snap_settings": "_load",
}
"""Module of each name, imported when it is first asked for: most commands need few."""

__getattr__ = late(__name__, _HOMES)
