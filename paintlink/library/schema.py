"""The tables of library.db, one numbered migration after another.

Nothing stored is ever changed or deleted: a change adds a generation, which shares all
blocks of paints that stayed the same.
"""

from __future__ import annotations

MIGRATIONS: tuple[tuple[str, ...], ...] = (
    (
        """
        CREATE TABLE libraries (
            id INTEGER PRIMARY KEY,
            token TEXT NOT NULL UNIQUE,
            angles_deg TEXT NOT NULL,
            observer TEXT NOT NULL CHECK (observer IN ('2', '10')),
            synthetic INTEGER NOT NULL CHECK (synthetic IN (0, 1))
        ) STRICT
        """,
        # Some thousands of paints in columns: `codes` and `names` are JSON arrays,
        # `finishes` one letter a paint; `ids`, `lab` (a run for each angle and letter)
        # and `gloss` little-endian 8 byte numbers. Ids never overlap between the
        # blocks of one generation.
        """
        CREATE TABLE blocks (
            id INTEGER PRIMARY KEY,
            library_id INTEGER NOT NULL REFERENCES libraries (id),
            digest TEXT NOT NULL,
            paints INTEGER NOT NULL CHECK (paints > 0),
            first_paint INTEGER NOT NULL,
            last_paint INTEGER NOT NULL,
            ids BLOB NOT NULL,
            codes TEXT NOT NULL,
            names TEXT NOT NULL,
            finishes TEXT NOT NULL,
            lab BLOB NOT NULL,
            gloss BLOB NOT NULL,
            UNIQUE (library_id, digest)
        ) STRICT
        """,
        # Further columns of a block: a JSON array of texts, one a paint.
        """
        CREATE TABLE extras (
            id INTEGER PRIMARY KEY,
            block_id INTEGER NOT NULL REFERENCES blocks (id),
            name TEXT NOT NULL,
            digest TEXT NOT NULL,
            texts TEXT NOT NULL,
            UNIQUE (block_id, name)
        ) STRICT
        """,
        # `key` is what matches and jobs refer to. `back_id` is where undo goes.
        """
        CREATE TABLE generations (
            id INTEGER PRIMARY KEY,
            key TEXT NOT NULL UNIQUE,
            library_id INTEGER NOT NULL REFERENCES libraries (id),
            number INTEGER NOT NULL,
            content_id INTEGER NOT NULL REFERENCES contents (id),
            back_id INTEGER REFERENCES generations (id),
            name TEXT NOT NULL,
            removed INTEGER NOT NULL CHECK (removed IN (0, 1)),
            change TEXT NOT NULL,
            made_at TEXT NOT NULL,
            UNIQUE (library_id, number)
        ) STRICT
        """,
        """
        CREATE TABLE contents (
            id INTEGER PRIMARY KEY,
            paints INTEGER NOT NULL
        ) STRICT
        """,
        """
        CREATE TABLE members (
            content_id INTEGER NOT NULL REFERENCES contents (id),
            block_id INTEGER NOT NULL REFERENCES blocks (id),
            PRIMARY KEY (content_id, block_id)
        ) STRICT, WITHOUT ROWID
        """,
    ),
)
