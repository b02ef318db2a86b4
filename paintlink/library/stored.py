"""The shop's own libraries in library.db: every generation of them."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from paintlink.library import generations
from paintlink.library.blocks import load_block
from paintlink.library.database import reading
from paintlink.library.diff import Difference, difference
from paintlink.library.generations import Generation
from paintlink.library.loading import (
    SPECIFICATION,
    block_ids,
    load_table,
    paint_extras,
    stored_column,
)
from paintlink.model import PaintTable


@dataclass(frozen=True, slots=True)
class StoredLibraries:
    """The libraries in one file, which need not be there yet."""

    path: Path

    def present(self) -> tuple[Generation, ...]:
        """The present generation of every library, by name."""
        return tuple(one for one in self._heads() if not one.removed)

    def removed(self) -> tuple[Generation, ...]:
        """The last generation of every library that was removed, by name."""
        return tuple(one for one in self._heads() if one.removed)

    def generation(self, key: str) -> Generation | None:
        """The generation with this key, of whatever library, present or removed."""
        with self._reading() as connection:
            return generations.by_key(connection, key) if connection else None

    def history(self, generation: Generation) -> tuple[Generation, ...]:
        """All generations of the same library, the first one first."""
        with reading(self.path) as connection:
            return tuple(generations.history(connection, generation.library_id))

    def table(self, generation: Generation) -> PaintTable:
        """The paints of a generation."""
        with reading(self.path) as connection:
            return load_table(connection, generation, self.path)

    def extras(self, generation: Generation, paint_id: int) -> dict[str, str]:
        """Every further column of one paint of a generation."""
        with reading(self.path) as connection:
            return paint_extras(connection, generation, paint_id)

    def specifications(self, generation: Generation) -> list[str]:
        """The document each paint was imported from, empty where there is none."""
        return stored_column(self.path, generation, SPECIFICATION)

    def difference(self, old: Generation, new: Generation) -> Difference:
        """What changed between two generations of one library.

        Only the blocks are read that the two do not share.
        """
        angles = new.conditions.angles_deg
        with reading(self.path) as connection:
            before, after = (set(block_ids(connection, one)) for one in (old, new))
            gone, come = (
                [load_block(connection, one, len(angles)) for one in sorted(ours)]
                for ours in (before - after, after - before)
            )
        return difference(gone, come, angles)

    def _heads(self) -> list[Generation]:
        with self._reading() as connection:
            return generations.heads(connection) if connection else []

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection | None]:
        if not self.path.exists():
            yield None
            return
        with reading(self.path) as connection:
            yield connection
