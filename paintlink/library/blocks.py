"""Blocks of paints: what a library is stored in, and what its generations share."""

from __future__ import annotations

import hashlib
import json
import sqlite3
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import LibraryStoreError
from paintlink.library.rows import Rows, together
from paintlink.model import FINISHES, Finish, FloatArray

_LETTER: dict[Finish, str] = {finish: finish[0] for finish in FINISHES}
_FINISH: dict[str, Finish] = {letter: finish for finish, letter in _LETTER.items()}
_NUMBER = np.dtype("<f8")
_ID = np.dtype("<i8")
COLUMNS = ("ids", "codes", "names", "finishes", "lab", "gloss")
"""Columns of a stored block in the order of its digest."""


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Some paints of a library with their stable ids, ascending."""

    ids: NDArray[np.int64]
    rows: Rows


def numbered(rows: Rows, first_id: int) -> Block:
    """Paints with new ids from ``first_id`` on."""
    return Block(np.arange(first_id, first_id + len(rows), dtype=np.int64), rows)


def store_block(connection: sqlite3.Connection, library_id: int, block: Block) -> int:
    """Id of the stored block; a block that is stored already is not stored again."""
    columns = _encoded(block)
    extras = {name: _json(texts) for name, texts in sorted(block.rows.extras.items())}
    digests = {name: digest_of([texts]) for name, texts in extras.items()}
    digest = _block_digest(columns.values(), digests.items())
    known = connection.execute(
        "SELECT id FROM blocks WHERE library_id = ? AND digest = ?",
        (library_id, digest),
    ).fetchone()
    if known:
        return int(known[0])
    cursor = connection.execute(
        "INSERT INTO blocks (library_id, digest, paints, first_paint, last_paint, "
        "ids, codes, names, finishes, lab, gloss) VALUES (?,?,?,?,?,?,?,?,?,?,?)",
        (
            library_id,
            digest,
            len(block.ids),
            int(block.ids[0]),
            int(block.ids[-1]),
            *columns.values(),
        ),
    )
    block_id = int(cursor.lastrowid or 0)
    connection.executemany(
        "INSERT INTO extras (block_id, name, digest, texts) VALUES (?, ?, ?, ?)",
        [(block_id, name, digests[name], texts) for name, texts in extras.items()],
    )
    return block_id


def load_block(connection: sqlite3.Connection, block_id: int, angles: int) -> Block:
    """A stored block with all its columns.

    Raises
    ------
    LibraryStoreError
        When it is damaged.
    """
    row = connection.execute("SELECT * FROM blocks WHERE id = ?", (block_id,))
    record = row.fetchone()
    check_block(connection, record)
    extras = connection.execute(
        "SELECT name, digest, texts FROM extras WHERE block_id = ?", (block_id,)
    )
    rows = Rows(
        codes=tuple(json.loads(record["codes"])),
        names=tuple(json.loads(record["names"])),
        finishes=finishes_of(record),
        lab=lab_planes(record, angles).transpose(2, 0, 1),
        gloss_gu=gloss_of(record),
        extras={extra["name"]: tuple(extra_texts(extra)) for extra in extras},
    )
    return Block(ids_of(record), rows)


def check_block(connection: sqlite3.Connection, record: sqlite3.Row) -> None:
    """Refuse a block that is not what was stored.

    Raises
    ------
    LibraryStoreError
        When it is damaged.
    """
    extras = connection.execute(
        "SELECT name, digest FROM extras WHERE block_id = ? ORDER BY name",
        (record["id"],),
    )
    columns = (record[name] for name in COLUMNS)
    if _block_digest(columns, map(tuple, extras)) != record["digest"]:
        raise _damaged(f"the paints {record['first_paint']} to {record['last_paint']}")


def extra_texts(record: sqlite3.Row) -> list[str]:
    """One further column of a stored block.

    Raises
    ------
    LibraryStoreError
        When it is damaged.
    """
    if digest_of([record["texts"]]) != record["digest"]:
        raise _damaged(f"the column {record['name']}")
    texts: list[str] = json.loads(record["texts"])
    return texts


def digest_of(columns: Iterable[str | bytes]) -> str:
    """SHA-256 over columns, none of which can pass for a part of another."""
    digest = hashlib.sha256()
    for column in columns:
        data = column.encode() if isinstance(column, str) else column
        digest.update(f"{len(data)}:".encode())
        digest.update(data)
    return digest.hexdigest()


def _block_digest(
    columns: Iterable[str | bytes], extras: Iterable[tuple[str, str]]
) -> str:
    return digest_of([*columns, *chain.from_iterable(extras)])


def _damaged(what: str) -> LibraryStoreError:
    msg = f"{what} in library.db are not what was stored: restore it from a backup"
    return LibraryStoreError(msg)


def ids_of(record: sqlite3.Row) -> NDArray[np.int64]:
    """Stable ids of the paints of a stored block."""
    return np.frombuffer(record["ids"], _ID)


def finishes_of(record: sqlite3.Row) -> tuple[Finish, ...]:
    """Finishes of the paints of a stored block."""
    return tuple(map(_FINISH.__getitem__, record["finishes"]))


def lab_planes(record: sqlite3.Row, angles: int) -> FloatArray:
    """Lab of a stored block, shape (angles, 3, n)."""
    return np.frombuffer(record["lab"], _NUMBER).reshape(angles, 3, record["paints"])


def gloss_of(record: sqlite3.Row) -> FloatArray:
    """Gloss of the paints of a stored block, NaN where unknown."""
    return np.frombuffer(record["gloss"], _NUMBER)


def take(block: Block, places: NDArray[np.int64]) -> Block:
    """The paints at these places of a block."""
    rows = block.rows
    return Block(
        block.ids[places],
        Rows(
            codes=_taken(rows.codes, places),
            names=_taken(rows.names, places),
            finishes=tuple(rows.finishes[place] for place in places),
            lab=rows.lab[places],
            gloss_gu=rows.gloss_gu[places],
            extras={name: _taken(texts, places) for name, texts in rows.extras.items()},
        ),
    )


def changed(old: Rows, new: Rows) -> Rows:
    """Paints after an update, both in the same order.

    What the update does not say stays: an empty name, an unknown finish or gloss, a
    column that it lacks.
    """
    stays = np.isnan(new.gloss_gu)
    return replace(
        new,
        names=tuple(b or a for a, b in zip(old.names, new.names, strict=True)),
        finishes=tuple(
            a if b == "unknown" else b
            for a, b in zip(old.finishes, new.finishes, strict=True)
        ),
        gloss_gu=np.where(stays, old.gloss_gu, new.gloss_gu),
        extras={**old.extras, **new.extras},
    )


def joined(blocks: Sequence[Block]) -> Block:
    """The paints of several blocks in the order of their ids."""
    ids = np.concatenate([block.ids for block in blocks])
    whole = Block(ids, together([block.rows for block in blocks]))
    return take(whole, np.argsort(ids, kind="stable"))


def _taken(texts: Sequence[str], places: NDArray[np.int64]) -> tuple[str, ...]:
    return tuple(texts[place] for place in places)


def _encoded(block: Block) -> dict[str, str | bytes]:
    rows = block.rows
    return {
        "ids": block.ids.astype(_ID).tobytes(),
        "codes": _json(rows.codes),
        "names": _json(rows.names),
        "finishes": "".join(map(_LETTER.__getitem__, rows.finishes)),
        "lab": np.ascontiguousarray(rows.lab.transpose(1, 2, 0), _NUMBER).tobytes(),
        "gloss": rows.gloss_gu.astype(_NUMBER).tobytes(),
    }


def _json(texts: Sequence[str]) -> str:
    return json.dumps(texts, ensure_ascii=False, separators=(",", ":"))
