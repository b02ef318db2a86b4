"""Export formats: one stylesheet each, those of the site beside the built-in ones."""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path

from lxml import etree

from paintlink.errors import ConfigError, ExportError
from paintlink.export.names import pattern_problem
from paintlink.export.refusals import METADATA, line_of
from paintlink.export.stylesheet import (
    compile_stylesheet,
    parse_stylesheet,
    stylesheet_error,
)

_ATTRIBUTES = {
    "id": (r"[a-z0-9][a-z0-9-]{0,31}", "lower-case letters, digits and dashes"),
    "label": (r"\S.{0,79}", "a short text"),
    "suffix": (r"[a-z0-9]{1,8}", "up to 8 lower-case letters and digits, no dot"),
    "file-name": (r".{1,100}", "a pattern such as {date}_{name}"),
    "starting-paint": (r"required|optional", "required or optional"),
}


@dataclass(frozen=True, slots=True)
class Format:
    """One way to write a colour specification for another program."""

    id: str
    label: str
    suffix: str
    name_pattern: str
    requires_starting_paint: bool
    source: Path
    transform: etree.XSLT = field(repr=False, compare=False)


class Formats(Mapping[str, Format]):
    """The formats that work, by id, and the reasons why others do not."""

    def __init__(
        self, formats: Mapping[str, Format], problems: tuple[ConfigError, ...] = ()
    ) -> None:
        self._formats = dict(sorted(formats.items()))
        self.problems = problems

    def __getitem__(self, format_id: str) -> Format:
        return self._formats[format_id]

    def __iter__(self) -> Iterator[str]:
        return iter(self._formats)

    def __len__(self) -> int:
        return len(self._formats)

    def find(self, format_id: str) -> Format:
        """The format of this id.

        Raises
        ------
        ExportError
            When there is none; names those there are and those that are broken.
        """
        if format_id in self._formats:
            return self._formats[format_id]
        broken = "".join(f"; broken: {problem}" for problem in self.problems)
        msg = f"no export format {format_id!r}; there are {', '.join(self)}{broken}"
        raise ExportError(msg, kind="format")


def load_formats(site_folder: Path | None = None) -> Formats:
    """The built-in formats and those of the site, which win where ids are equal.

    A site stylesheet that does not work stands in `Formats.problems`; the others stay
    usable.

    Raises
    ------
    ConfigError
        When the site folder is missing, or others than its owner may write to it.
    """
    found = {path.stem: load_format(path) for path in _stylesheets(_built_in())}
    if site_folder is None:
        return Formats(found)
    problems = []
    for path in _stylesheets(_trusted(site_folder)):
        try:
            found[path.stem] = load_format(_trusted(path))
        except ConfigError as error:
            problems.append(error)
    return Formats(found, tuple(problems))


def load_format(source: Path) -> Format:
    """The format that a stylesheet describes, compiled.

    Raises
    ------
    ConfigError
        With file and line, for what is not allowed and what does not work.
    """
    root = parse_stylesheet(_read(source), source)
    element = _metadata_element(root, source)
    values = {name: _metadata(element, name, source) for name in _ATTRIBUTES}
    if values["id"] != source.stem:
        msg = f"id {values['id']!r} differs from the file name; make them equal"
        raise stylesheet_error(source, line_of(element), msg)
    return Format(
        id=values["id"],
        label=values["label"],
        suffix=values["suffix"],
        name_pattern=values["file-name"],
        requires_starting_paint=values["starting-paint"] == "required",
        source=source,
        transform=compile_stylesheet(root, source),
    )


def _built_in() -> Path:
    return Path(str(resources.files("paintlink.export") / "formats"))


def _stylesheets(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.xslt"))


def _trusted(path: Path) -> Path:
    """A path that nobody but its owner, who is root or this user, can change."""
    try:
        state = path.lstat()
    except OSError as error:
        msg = f"{path}: {error.strerror}; create it or correct the configuration"
        raise ConfigError(msg) from error
    if stat.S_ISLNK(state.st_mode):
        msg = f"{path}: a symbolic link; put the stylesheets themselves here"
        raise ConfigError(msg)
    if state.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        msg = f"{path}: others may write to it; run chmod go-w on it"
        raise ConfigError(msg)
    if state.st_uid not in {0, os.geteuid()}:
        msg = f"{path}: belongs to user {state.st_uid}; give it to root"
        raise ConfigError(msg)
    return path


def _read(source: Path) -> bytes:
    try:
        return source.read_bytes()
    except OSError as error:
        msg = f"cannot be read ({error.strerror}); correct its permissions"
        raise stylesheet_error(source, None, msg) from error


def _metadata_element(root: etree._Element, source: Path) -> etree._Element:
    found = root.findall(f"{{{METADATA}}}format")
    if len(found) != 1:
        msg = f'needs one <format xmlns="{METADATA}"> at the top, found {len(found)}'
        raise stylesheet_error(source, line_of(root), msg)
    return found[0]


def _metadata(element: etree._Element, name: str, source: Path) -> str:
    pattern, meaning = _ATTRIBUTES[name]
    value = element.get(name, "")
    problem = None
    if not re.fullmatch(pattern, value):
        problem = f"{name}={value!r} must be {meaning}"
    elif name == "file-name":
        problem = pattern_problem(value)
    if problem:
        raise stylesheet_error(source, line_of(element), problem)
    return value
