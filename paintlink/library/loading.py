"""A stored generation as a table in memory."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from paintlink.library.blocks import (
    Block,
    check_block,
    extra_texts,
    finishes_of,
    gloss_of,
    ids_of,
    lab_planes,
    load_block,
)
from paintlink.library.database import reading
from paintlink.library.facets import LazyFacets
from paintlink.library.generations import Generation
from paintlink.model import Finish, PaintTable

SPECIFICATION = "specification"
"""The extra column of the whole document a paint came from; no facet."""


def load_table(
    connection: sqlite3.Connection, generation: Generation, path: Path
) -> PaintTable:
    """The paints of a generation; further columns are read when they are asked for."""
    angles = generation.conditions.angles_deg
    planes = np.empty((len(angles), 3, generation.paints))
    ids = np.empty(generation.paints, dtype=np.int64)
    gloss = np.empty(generation.paints)
    codes: list[str] = []
    names: list[str] = []
    finishes: list[Finish] = []
    for record in _records(connection, generation):
        check_block(connection, record)
        run = slice(len(codes), len(codes) + record["paints"])
        planes[..., run] = lab_planes(record, len(angles))
        ids[run], gloss[run] = ids_of(record), gloss_of(record)
        codes += json.loads(record["codes"])
        names += json.loads(record["names"])
        finishes += finishes_of(record)
    for array in (planes, ids, gloss):
        array.setflags(write=False)
    return PaintTable(
        library=generation.name,
        generation=generation.key,
        synthetic=generation.conditions.synthetic,
        observer=generation.conditions.observer,
        ids=ids,
        codes=tuple(codes),
        names=tuple(names),
        finishes=tuple(finishes),
        angles_deg=angles,
        lab=planes.transpose(2, 0, 1),
        gloss_gu=None if np.isnan(gloss).all() else gloss,
        facets=LazyFacets({
            name: partial(stored_column, path, generation, name)
            for name in _names(connection, generation)
        }),
    )


def load_blocks(
    connection: sqlite3.Connection, generation: Generation
) -> Iterator[tuple[int, Block]]:
    """The blocks of a generation with all columns, and their ids."""
    angles = len(generation.conditions.angles_deg)
    for block_id in block_ids(connection, generation):
        yield block_id, load_block(connection, block_id, angles)


def block_ids(connection: sqlite3.Connection, generation: Generation) -> list[int]:
    """Ids of the blocks of a generation in the order of their paints."""
    sql = (
        "SELECT id FROM blocks JOIN members ON block_id = id WHERE content_id = ? "
        "ORDER BY first_paint"
    )
    return [row[0] for row in connection.execute(sql, (generation.content_id,))]


def block_codes(
    connection: sqlite3.Connection, generation: Generation
) -> Iterator[tuple[int, list[str]]]:
    """The codes of each block of a generation, and its id."""
    sql = (
        "SELECT id, codes FROM blocks JOIN members ON block_id = id "
        "WHERE content_id = ? ORDER BY first_paint"
    )
    for block_id, codes in connection.execute(sql, (generation.content_id,)):
        yield block_id, json.loads(codes)


def stored_column(path: Path, generation: Generation, name: str) -> list[str]:
    """One further column of a generation in the file of the libraries."""
    with reading(path) as connection:
        return column_texts(connection, generation, name)


def column_texts(
    connection: sqlite3.Connection, generation: Generation, name: str
) -> list[str]:
    """One further column of all paints, empty where a paint has none."""
    rows = connection.execute(
        "SELECT paints, extras.* FROM members "
        "JOIN blocks ON blocks.id = members.block_id "
        "LEFT JOIN extras ON extras.block_id = blocks.id AND extras.name = ? "
        "WHERE content_id = ? ORDER BY first_paint",
        (name, generation.content_id),
    )
    texts: list[str] = []
    for row in rows:
        texts += extra_texts(row) if row["texts"] else [""] * row["paints"]
    return texts


def paint_extras(
    connection: sqlite3.Connection, generation: Generation, paint_id: int
) -> dict[str, str]:
    """Every further column of one paint."""
    row = connection.execute(
        "SELECT blocks.id, ids FROM blocks JOIN members ON block_id = blocks.id "
        "WHERE content_id = ? AND ? BETWEEN first_paint AND last_paint",
        (generation.content_id, paint_id),
    ).fetchone()
    place = int(np.searchsorted(ids_of(row), paint_id))
    extras = connection.execute(
        "SELECT * FROM extras WHERE block_id = ? ORDER BY id", (row["id"],)
    )
    values = {extra["name"]: extra_texts(extra)[place] for extra in extras}
    return {name: text for name, text in values.items() if text}


def _records(
    connection: sqlite3.Connection, generation: Generation
) -> Iterator[sqlite3.Row]:
    return connection.execute(
        "SELECT blocks.* FROM blocks JOIN members ON block_id = blocks.id "
        "WHERE content_id = ? ORDER BY first_paint",
        (generation.content_id,),
    )


def _names(connection: sqlite3.Connection, generation: Generation) -> list[str]:
    rows = connection.execute(
        "SELECT name, min(extras.id) AS first FROM extras "
        "JOIN members ON members.block_id = extras.block_id WHERE content_id = ? "
        "GROUP BY name ORDER BY first",
        (generation.content_id,),
    )
    return [row["name"] for row in rows if row["name"] != SPECIFICATION]
