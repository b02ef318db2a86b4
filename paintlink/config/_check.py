"""A file and the environment become settings, or one error with all their faults."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from paintlink.config._clashes import clashes
from paintlink.config._document import REPEATED, SECTIONS, keys
from paintlink.config._file import read_table
from paintlink.config._keys import is_written_in_quotes
from paintlink.config._overlay import Overlay, number_or_flag, overlay, variable
from paintlink.config._tables import Table, section, settle_folders
from paintlink.config._texts import refusal, unknown
from paintlink.config._validate import validate
from paintlink.config.settings import Settings


def checked(source: Path | None, *, environ: Mapping[str, str]) -> Settings:
    """Settings from a file, or from none, with the environment put over it.

    Raises
    ------
    ConfigError
        Naming every fault, a line each.
    """
    table = read_table(source) if source else {}
    given = overlay(environ)
    lines = list(_lay(given, over=table))
    path = source.absolute() if source else None
    settle_folders(table, path.parent if path else Path.cwd(), environ)
    document, faults = validate(table)
    lines += [one.line(table, given, source) for one in (*faults, *clashes(table))]
    if lines or document is None:
        raise refusal(lines)
    return document.settings(path)


def _lay(given: Overlay, *, over: Table) -> Iterator[str]:
    """Put the values into the table; what comes back are faults of their names."""
    for (name, key), text in given.items():
        place = f"environment: {variable(name, key)}"
        if name in REPEATED:
            yield f"{place}: [[{name}]] can only be written in a file"
        elif name not in SECTIONS:
            yield f"{place}: {unknown('section', name, SECTIONS)}"
        else:
            quoted = is_written_in_quotes(keys(name).get(key))
            section(over, name)[key] = text if quoted else number_or_flag(text)
