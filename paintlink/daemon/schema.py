"""The journal's tables: one numbered SQL file in ``migrations/`` after another.

To change a table, add a file with the next number; a file that was released is never
edited again, for journals in the field have run it already.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from functools import cache
from importlib import resources

from paintlink.errors import JournalError


@cache
def migrations() -> tuple[tuple[str, ...], ...]:
    """The statements of every migration, in the order of their numbers.

    Raises
    ------
    JournalError
        When the numbers of the files are not 1, 2, 3, ...
    """
    folder = resources.files("paintlink.daemon") / "migrations"
    names = sorted(one.name for one in folder.iterdir() if one.name.endswith(".sql"))
    for number, name in enumerate(names, start=1):
        if not name.startswith(f"{number:04d}_"):
            msg = f"{name}: migration {number} was expected; number the files anew"
            raise JournalError(msg)
    return tuple(
        tuple(_statements((folder / name).read_text("utf-8"))) for name in names
    )


def newest_version() -> int:
    """The version of a journal that this program writes."""
    return len(migrations())


def migrate(connection: sqlite3.Connection, version: int) -> None:
    """Bring a journal of a version to the newest, inside the caller's transaction.

    Foreign keys must be off: tables are replaced by wider ones of the same name.
    """
    for number, statements in enumerate(migrations()[version:], start=version + 1):
        for statement in statements:
            connection.execute(statement)
        connection.execute(f"PRAGMA user_version={number}")


def _statements(script: str) -> Iterator[str]:
    statement = ""
    for line in script.splitlines(keepends=True):
        statement += line
        if sqlite3.complete_statement(statement):
            yield statement
            statement = ""
