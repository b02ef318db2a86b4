"""The configuration file as a whole: its sections and their keys."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args, get_type_hints

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """The sections, named and ordered as in the file."""

    site: SiteSettings
    state: StateSettings
    instrument: tuple[InstrumentSettings, ...] = ()
    inbox: InboxSettings
    snap: SnapSettings = field(default_factory=SnapSettings)
    route: tuple[RouteSettings, ...] = ()
    template: tuple[TemplateSettings, ...] = ()
    sink: tuple[SinkSettings, ...] = ()
    formulation: FormulationSettings = field(default_factory=FormulationSettings)
    preview: PreviewSettings = field(default_factory=PreviewSettings)
    log: LogSettings = field(default_factory=LogSettings)

    def settings(self, source: Path | None) -> Settings:
        """The same for the daemon."""
        return Settings(
            site=self.site,
            state=self.state,
            instruments=self.instrument,
            inbox=self.inbox,
            snap=self.snap,
            routes=self.route,
            templates=self.template,
            sinks=self.sink,
            formulation=self.formulation,
            preview=self.preview,
            log=self.log,
            source=source,
        )


_HINTS = get_type_hints(Document)

REPEATED = tuple(name for name, hint in _HINTS.items() if get_args(hint))
SECTIONS = {name: (*get_args(hint), hint)[0] for name, hint in _HINTS.items()}


def keys(section: str) -> dict[str, Any]:
    """Type, limits and meaning of each key of a section."""
    return get_type_hints(SECTIONS[section], include_extras=True)
