"""The built-in settings, of somebody who has written none."""

from __future__ import annotations

from collections.abc import Mapping

from paintlink.config._places import inbox_folder, site_folder, state_folder
from paintlink.config.sections.inbox import InboxSettings
from paintlink.config.sections.site import SiteSettings, StateSettings
from paintlink.config.settings import Settings


def default_settings(*, environ: Mapping[str, str]) -> Settings:
    """Settings without a file: no instrument and no route."""
    site = site_folder(environ)
    return Settings(
        site=SiteSettings(folder=site),
        state=StateSettings(folder=state_folder(environ)),
        inbox=InboxSettings(folder=inbox_folder(site)),
    )
