"""What the service is told, complete and ready to be used."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from paintlink.config._places import is_absent
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """Everything the service was told; every folder is an absolute path.

    ``source`` is the file the settings come from, None for the built-in ones.
    """

    site: SiteSettings
    state: StateSettings
    inbox: InboxSettings
    instruments: tuple[InstrumentSettings, ...] = ()
    snap: SnapSettings = field(default_factory=SnapSettings)
    routes: tuple[RouteSettings, ...] = ()
    templates: tuple[TemplateSettings, ...] = ()
    sinks: tuple[SinkSettings, ...] = ()
    formulation: FormulationSettings = field(default_factory=FormulationSettings)
    preview: PreviewSettings = field(default_factory=PreviewSettings)
    log: LogSettings = field(default_factory=LogSettings)
    source: Path | None = None

    @property
    def site_folder(self) -> Path:
        """Folder of the folders that files pass through."""
        return self.site.folder

    @property
    def state_folder(self) -> Path:
        """Folder of everything the service remembers."""
        return self.state.folder

    @property
    def log_level(self) -> str:
        """Least important message to write."""
        return self.log.level

    @property
    def answering_route(self) -> str:
        """Name of the route whose program answers; empty when there is none."""
        named = self.formulation.route
        found = [one.name for one in self.routes if one.format == "colornet"]
        return named or (found[0] if found else "")

    @property
    def orders_folder(self) -> Path:
        """Folder where other programs say what is to be measured."""
        return self.site.folder / "jobs"

    @property
    def drawings_folder(self) -> Path:
        """Folder where a colour file that is dropped gets its picture beside it."""
        return self.site.folder / "previews"

    @property
    def answers_folder(self) -> Path:
        """Folder where the formulation software puts its answers."""
        return self.site.folder / "answers"

    @property
    def journal_path(self) -> Path:
        """The journal, the only queue of the service."""
        return self.state.folder / "journal.db"

    @property
    def library_path(self) -> Path:
        """The shop's own paint libraries."""
        return self.state.folder / "library.db"

    @property
    def indexes_folder(self) -> Path:
        """Folder of the search trees; safe to delete, they grow again."""
        return self.state.folder / "indexes"

    @property
    def captures_folder(self) -> Path:
        """Folder of the captured sessions with instruments."""
        return self.state.folder / "captures"

    @property
    def previews_folder(self) -> Path:
        """Folder of the pictures that were drawn."""
        return self.state.folder / "previews"

    @property
    def profiles_folder(self) -> Path | None:
        """Folder ``profiles`` beside the configuration file; None without one."""
        folder = self.source.parent / "profiles" if self.source else None
        return None if folder is None or is_absent(folder) else folder

    @property
    def formats_folder(self) -> Path | None:
        """Folder ``formats`` beside the configuration file; None when there is none."""
        folder = self.source.parent / "formats" if self.source else None
        return None if folder is None or is_absent(folder) else folder
