"""The parsed file before it is checked: nested dictionaries of unknown quality."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from paintlink.config._places import inbox_folder, site_folder, state_folder

Table = dict[str, Any]


def section(table: Table, name: str) -> Table:
    """The section, added when missing; a stand-in when something else has its name."""
    found = table.setdefault(name, {})
    return found if isinstance(found, dict) else {}


def entries(table: Table, name: str) -> Iterator[tuple[int, Table]]:
    """Index and content of each well-formed block of a repeated section."""
    found = table.get(name)
    for index, entry in enumerate(found if isinstance(found, list) else ()):
        if isinstance(entry, dict):
            yield index, entry


def settle_folders(table: Table, base: Path, environ: Mapping[str, str]) -> None:
    """Fill in the folders that were left out and make all of them absolute, in place.

    Parameters
    ----------
    base
        Folder that relative paths start from.
    """
    site = _settle(section(table, "site"), base, site_folder(environ))
    _settle(section(table, "state"), base, state_folder(environ))
    _settle(section(table, "inbox"), base, inbox_folder(site))
    for _, route in entries(table, "route"):
        _make_absolute(route, base)


def _settle(owner: Table, base: Path, default: Path) -> Path:
    """The folder of a section; the default also where what is written is no folder."""
    owner.setdefault("folder", str(default))
    _make_absolute(owner, base)
    folder = owner["folder"]
    usable = isinstance(folder, str) and Path(folder).is_absolute()
    return Path(folder) if usable else default


def _make_absolute(owner: Table, base: Path) -> None:
    folder = owner.get("folder")
    if isinstance(folder, str) and folder.strip() and not folder.startswith("~"):
        owner["folder"] = os.path.normpath(base / folder)
