"""The generations of the stored libraries: every state a library was ever in."""

from __future__ import annotations

import os
import sqlite3
from dataclasses import dataclass

from paintlink.errors import LibraryError
from paintlink.library.blocks import digest_of
from paintlink.library.rows import Conditions

KEY_LENGTH = 12
_FIELDS = """
    generations.*, contents.paints, libraries.angles_deg, libraries.observer,
    libraries.synthetic
    FROM generations
    JOIN contents ON contents.id = generations.content_id
    JOIN libraries ON libraries.id = generations.library_id
"""
_HEADS = """
    generations.id IN (SELECT max(id) FROM generations GROUP BY library_id)
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Generation:
    """One state of one library.

    Parameters
    ----------
    key
        What matches and jobs refer to.
    number
        1 for the first of its library.
    name
        Name of the library in this generation.
    change
        How it came from the one before, in words.
    made_at
        UTC, ISO 8601.
    """

    id: int
    key: str
    library_id: int
    number: int
    content_id: int
    back_id: int | None
    name: str
    removed: bool
    change: str
    made_at: str
    paints: int
    conditions: Conditions


def heads(connection: sqlite3.Connection) -> list[Generation]:
    """The present generation of every library, removed ones too, by name."""
    rows = connection.execute(f"SELECT {_FIELDS} WHERE {_HEADS} ORDER BY name, id")
    return [_generation(row) for row in rows]


def history(connection: sqlite3.Connection, library_id: int) -> list[Generation]:
    """All generations of a library, the first one first."""
    sql = f"SELECT {_FIELDS} WHERE generations.library_id = ? ORDER BY number"
    return [_generation(row) for row in connection.execute(sql, (library_id,))]


def by_key(connection: sqlite3.Connection, key: str) -> Generation | None:
    """The generation with this key."""
    sql = f"SELECT {_FIELDS} WHERE generations.key = ?"
    row = connection.execute(sql, (key,)).fetchone()
    return _generation(row) if row else None


def by_id(connection: sqlite3.Connection, generation_id: int) -> Generation:
    """The generation with this id."""
    sql = f"SELECT {_FIELDS} WHERE generations.id = ?"
    return _generation(connection.execute(sql, (generation_id,)).fetchone())


def by_name(
    connection: sqlite3.Connection, name: str, *, removed: bool = False
) -> Generation | None:
    """The present generation of the library of this name, in any case.

    With ``removed``, of the library of this name that was removed last.
    """
    known = [one for one in heads(connection) if one.name.casefold() == name.casefold()]
    found = [one for one in known if one.removed == removed]
    return max(found, key=lambda one: one.id, default=None)


def new_library(connection: sqlite3.Connection, conditions: Conditions) -> int:
    """Id of a new library without any generation yet."""
    angles = " ".join(f"{angle:g}" for angle in conditions.angles_deg)
    cursor = connection.execute(
        "INSERT INTO libraries (token, angles_deg, observer, synthetic) "
        "VALUES (?, ?, ?, ?)",
        (os.urandom(8).hex(), angles, conditions.observer, conditions.synthetic),
    )
    return int(cursor.lastrowid or 0)


def new_content(
    connection: sqlite3.Connection, block_ids: list[int], paints: int
) -> int:
    """Id of a content made of these blocks."""
    cursor = connection.execute("INSERT INTO contents (paints) VALUES (?)", (paints,))
    content_id = int(cursor.lastrowid or 0)
    connection.executemany(
        "INSERT INTO members (content_id, block_id) VALUES (?, ?)",
        [(content_id, block_id) for block_id in block_ids],
    )
    return content_id


def add(
    connection: sqlite3.Connection,
    library_id: int,
    *,
    before: Generation | None,
    back_id: int | None,
    content_id: int,
    name: str,
    removed: bool,
    change: str,
    made_at: str,
) -> Generation:
    """The new present generation of a library.

    Its key is a hash over the key of the one before and all that is new.
    """
    token = connection.execute(
        "SELECT token FROM libraries WHERE id = ?", (library_id,)
    ).fetchone()[0]
    blocks = connection.execute(
        "SELECT digest FROM members JOIN blocks ON blocks.id = block_id "
        "WHERE content_id = ? ORDER BY first_paint",
        (content_id,),
    )
    facts = [token, before.key if before else "", name, str(removed), change, made_at]
    key = digest_of([*facts, *(row[0] for row in blocks)])[:KEY_LENGTH]
    cursor = connection.execute(
        "INSERT INTO generations (key, library_id, number, content_id, back_id, name, "
        "removed, change, made_at) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            key,
            library_id,
            before.number + 1 if before else 1,
            content_id,
            back_id,
            name,
            removed,
            change,
            made_at,
        ),
    )
    return by_id(connection, int(cursor.lastrowid or 0))


def check_name(name: str, known: list[Generation], taken: tuple[str, ...]) -> str:
    """The name, without blanks around it.

    Raises
    ------
    LibraryError
        When a library cannot be called so, or another one is.
    """
    name = name.strip()
    if not name or len(name) > 60 or not name.isprintable() or name.startswith("-"):
        msg = (
            f"a library cannot be called {name!r}: take 1 to 60 printable characters "
            "that do not begin with a hyphen"
        )
        raise LibraryError(msg)
    used = {one.name.casefold() for one in known if not one.removed}
    if name.casefold() in used | {one.casefold() for one in taken}:
        msg = f"there is a library {name!r} already: choose another name"
        raise LibraryError(msg)
    return name


def _generation(row: sqlite3.Row) -> Generation:
    return Generation(
        id=row["id"],
        key=row["key"],
        library_id=row["library_id"],
        number=row["number"],
        content_id=row["content_id"],
        back_id=row["back_id"],
        name=row["name"],
        removed=bool(row["removed"]),
        change=row["change"],
        made_at=row["made_at"],
        paints=row["paints"],
        conditions=Conditions(
            angles_deg=tuple(map(float, row["angles_deg"].split())),
            observer=row["observer"],
            synthetic=bool(row["synthetic"]),
        ),
    )
