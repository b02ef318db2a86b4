"""What a change to the stored libraries is made of."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from paintlink.errors import LibraryError
from paintlink.library import generations
from paintlink.library.blocks import Block, store_block
from paintlink.library.generations import Generation
from paintlink.library.loading import block_ids


@dataclass(frozen=True, slots=True)
class Content:
    """The blocks of a library in the order of their paints, all of them stored."""

    block_ids: list[int]
    paints: int


@dataclass(frozen=True, slots=True)
class Change:
    """One change in the making: the stored libraries inside a transaction."""

    connection: sqlite3.Connection
    made_at: str

    def heads(self) -> list[Generation]:
        """The present generation of every library, removed ones too."""
        return generations.heads(self.connection)

    def head(self, name: str) -> Generation | None:
        """The present generation of the library of this name."""
        return generations.by_name(self.connection, name)

    def require(self, name: str, *, removed: bool = False) -> Generation:
        """The same.

        Raises
        ------
        LibraryError
            When there is none; names those there are.
        """
        found = generations.by_name(self.connection, name, removed=removed)
        if found is None:
            names = [one.name for one in self.heads() if not one.removed]
            msg = (
                f"no library of your own is called {name!r}; there is "
                f"{', '.join(names) or 'none yet'}: see `paintlink library libraries`"
            )
            raise LibraryError(msg)
        return found

    def next_paint_id(self, library_id: int) -> int:
        """Ids are never given twice, not even those of paints that were removed."""
        row = self.connection.execute(
            "SELECT max(last_paint) FROM blocks WHERE library_id = ?", (library_id,)
        ).fetchone()
        return int(row[0] or 0) + 1

    def content(
        self,
        library_id: int,
        blocks: Iterable[int | Block],
        progress: Callable[[int], None] = lambda stored: None,
    ) -> Content:
        """What a library holds next: new blocks stored, others named by their id.

        Raises
        ------
        LibraryError
            When nothing would be left.
        """
        block_ids, paints = [], 0
        for block in blocks:
            if isinstance(block, Block):
                block_ids.append(store_block(self.connection, library_id, block))
                paints += len(block.ids)
            else:
                block_ids.append(block)
                paints += self._paints_of(block)
            progress(paints)
        if not paints:
            msg = "nothing would be left in the library: remove the library itself"
            raise LibraryError(msg)
        return Content(block_ids, paints)

    def first(
        self, library_id: int, name: str, content: Content, change: str
    ) -> Generation:
        """The first generation of a library."""
        return self._add(library_id, None, name=name, content=content, change=change)

    def next(
        self,
        head: Generation,
        *,
        change: str,
        content: Content | None = None,
        name: str = "",
        removed: bool = False,
    ) -> Generation:
        """The generation after the present one; what is not said stays.

        It is the present one itself when the paints would be the same.
        """
        if content and content.block_ids == block_ids(self.connection, head):
            return head
        return self._add(
            head.library_id,
            head,
            name=name or head.name,
            content=content or head.content_id,
            change=change,
            removed=removed,
        )

    def back(
        self, head: Generation, goal: Generation, change: str, *, back_id: int | None
    ) -> Generation:
        """A generation in the state of an old one; undo goes to ``back_id`` from it."""
        return generations.add(
            self.connection,
            head.library_id,
            before=head,
            back_id=back_id,
            content_id=goal.content_id,
            name=goal.name,
            removed=goal.removed,
            change=change,
            made_at=self.made_at,
        )

    def _add(
        self,
        library_id: int,
        head: Generation | None,
        *,
        name: str,
        content: Content | int,
        change: str,
        removed: bool = False,
    ) -> Generation:
        if isinstance(content, Content):
            content = generations.new_content(
                self.connection, content.block_ids, content.paints
            )
        return generations.add(
            self.connection,
            library_id,
            before=head,
            back_id=head.id if head else None,
            content_id=content,
            name=name,
            removed=removed,
            change=change,
            made_at=self.made_at,
        )

    def _paints_of(self, block_id: int) -> int:
        sql = "SELECT paints FROM blocks WHERE id = ?"
        return int(self.connection.execute(sql, (block_id,)).fetchone()[0])
