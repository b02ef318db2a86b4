"""What the service is told: one TOML file, checked as a whole, as frozen settings."""

from paintlink.config._explain import explain
from paintlink.config._known import check_against
from paintlink.config._load import default_settings, find_config, load_settings
from paintlink.config._sections import (
    FormulationSettings,
    InboxSettings,
    InstrumentSettings,
    LogSettings,
    PreviewSettings,
    RouteSettings,
    SinkSettings,
    SiteSettings,
    SnapSettings,
    StateSettings,
    TemplateSettings,
)
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
]
