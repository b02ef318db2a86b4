"""Values that are right by themselves and wrong together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from itertools import combinations
from pathlib import Path

from paintlink.config._document import REPEATED
from paintlink.config._faults import Fault
from paintlink.config._tables import Table, entries, section
from paintlink.config._texts import block, shown
from paintlink.config.sections.snap import SnapSettings
from paintlink.intake import InboxFolders


def clashes(table: Table) -> Iterator[Fault]:
    """Faults between keys of a table whose folders are all absolute.

    Values of the wrong kind are passed over: they are told as such elsewhere.
    """
    for name in REPEATED:
        yield from _same_names(table, name)
    yield from _shared_folders(table)
    yield from _own_folders(table)
    yield from _limits(table)


def _same_names(table: Table, repeated: str) -> Iterator[Fault]:
    first: dict[str, int] = {}
    for index, name in _texts(table, repeated, "name"):
        earlier = first.setdefault(name, index)
        if earlier != index:
            head = block(repeated, earlier)
            text = f"name = {shown(name)}: {head} has it already; each needs its own"
            yield Fault(repeated, index, "name", text)


def _shared_folders(table: Table) -> Iterator[Fault]:
    written = _texts(table, "route", "folder")
    folders = [(index, text) for index, text in written if Path(text).is_absolute()]
    for (earlier, first), (index, second) in combinations(folders, 2):
        if _touch(Path(first), Path(second)):
            text = (
                f"folder = {shown(second)}: {block('route', earlier)} uses "
                f"{shown(first)}; give each program a folder of its own, neither "
                "inside the other"
            )
            yield Fault("route", index, "folder", text)


def _own_folders(table: Table) -> Iterator[Fault]:
    site = Path(str(section(table, "site").get("folder")))
    inbox = Path(str(section(table, "inbox").get("folder")))
    own = asdict(InboxFolders.below(site, inbox)) | {
        "answers": site / "answers",
        "jobs": site / "jobs",
        "previews": site / "previews",
    }
    uses = {folder: name for name, folder in own.items()}
    for index, folder in _texts(table, "route", "folder"):
        if Path(folder) in uses:
            use = uses[Path(folder)]
            text = f"folder = {shown(folder)}: paintlink's own {use}; choose another"
            yield Fault("route", index, "folder", text)


def _limits(table: Table) -> Iterator[Fault]:
    snap, default = section(table, "snap"), SnapSettings()
    green, amber = snap.get("green", default.green), snap.get("amber", default.amber)
    numbers = isinstance(green, int | float) and isinstance(amber, int | float)
    if numbers and green > amber:
        text = f"green = {shown(green)}: must not be above amber = {shown(amber)}"
        yield Fault("snap", None, "green", text)


def _texts(table: Table, repeated: str, key: str) -> list[tuple[int, str]]:
    found = ((index, entry.get(key)) for index, entry in entries(table, repeated))
    return [(index, text) for index, text in found if isinstance(text, str)]


def _touch(first: Path, second: Path) -> bool:
    return first == second or first in second.parents or second in first.parents
