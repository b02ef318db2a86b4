"""Every change that can be made to the shop's own libraries."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from paintlink.errors import LibraryError
from paintlink.library import generations
from paintlink.library.blocks import Block, load_block, take
from paintlink.library.change import Change
from paintlink.library.database import writing
from paintlink.library.fitting import fitting
from paintlink.library.generations import Generation, check_name
from paintlink.library.incoming import Incoming, Progress, untold
from paintlink.library.loading import block_codes, block_ids, load_blocks
from paintlink.library.merging import Mode, Stored, merged
from paintlink.library.rows import RowError, check

Clock = Callable[[], datetime]
WORDS: dict[Mode, str] = {
    "add": "imported",
    "update": "updated from",
    "replace": "replaced by",
}


def utc_now() -> datetime:
    """The present, as an aware UTC time."""
    return datetime.now(UTC)


@dataclass(frozen=True, slots=True)
class Editor:
    """Makes changes; each is one transaction, makes a generation and loses nothing.

    Parameters
    ----------
    taken
        Names no library may have, because libraries outside the file have them.
    """

    path: Path
    taken: tuple[str, ...] = ()
    now: Clock = utc_now

    def import_paints(
        self,
        name: str,
        incoming: Incoming,
        mode: Mode = "add",
        *,
        dry_run: bool = False,
        progress: Progress = untold,
    ) -> Generation:
        """Put paints into the library of this name, which is made when there is none.

        A dry run does everything, and then takes it back.

        Raises
        ------
        ImportRefusedError
            When `add` brings codes that are there already.
        LibraryError
            When the paints were measured under other conditions than the library's.
        """
        with self._writing(discard=dry_run) as store:
            head = store.head(name)
            if head is None:
                name = check_name(name, store.heads(), self.taken)
                conditions = incoming.conditions
                library_id = generations.new_library(store.connection, conditions)
                blocks: Iterable[Stored] = ()
            else:
                incoming = fitting(incoming, head)
                library_id = head.library_id
                blocks = load_blocks(store.connection, head)
            after = merged(blocks, incoming, mode, store.next_paint_id(library_id))
            total = (head.paints if head else 0) + len(incoming)
            content = store.content(
                library_id, after, lambda stored: progress(min(stored / total, 1.0))
            )
            source = Path(incoming.source).name
            change = f"{WORDS[mode]} {len(incoming)} paints of {source}"
            if head is None:
                return store.first(library_id, name, content, change)
            return store.next(head, content=content, change=change)

    def rename(self, name: str, new_name: str) -> Generation:
        """Give a library another name; what refers to its generations stays right."""
        with self._writing() as store:
            head = store.require(name)
            others = [one for one in store.heads() if one.id != head.id]
            new_name = check_name(new_name, others, self.taken)
            change = f"renamed from {head.name}"
            return store.next(head, name=new_name, change=change)

    def remove(self, name: str) -> Generation:
        """Take a library off the shelf; its generations stay, and undo brings it back.

        The returned generation still holds the paints.
        """
        with self._writing() as store:
            return store.next(store.require(name), removed=True, change="removed")

    def undo(self, name: str) -> Generation:
        """Take back the last change that was not taken back yet.

        Raises
        ------
        LibraryError
            When there is none.
        """
        with self._writing() as store:
            head = store.head(name) or store.require(name, removed=True)
            if head.back_id is None:
                msg = (
                    f"{head.name}: nothing to undo, this is its first generation; "
                    "`paintlink library remove` takes it off the shelf"
                )
                raise LibraryError(msg)
            goal = generations.by_id(store.connection, head.back_id)
            change = f"took back: {head.change}"
            return self._back_to(store, head, goal, change, back_id=goal.back_id)

    def restore(self, key: str) -> Generation:
        """Make an old generation of a library the present one again."""
        with self._writing() as store:
            goal = generations.by_key(store.connection, key)
            if goal is None:
                msg = (
                    f"no library has a generation {key!r}: `paintlink library history` "
                    "lists them"
                )
                raise LibraryError(msg)
            head = generations.history(store.connection, goal.library_id)[-1]
            change = f"restored generation {goal.number}"
            return self._back_to(store, head, goal, change, back_id=head.id)

    def remove_paints(self, name: str, codes: Iterable[str]) -> Generation:
        """Take some paints out of a library."""
        gone = list(dict.fromkeys(codes))

        def without(block: Block) -> Block | None:
            stays = [code not in gone for code in block.rows.codes]
            return take(block, np.flatnonzero(stays)) if any(stays) else None

        words = ", ".join(gone[:3]) + (f" and {len(gone) - 3} more" if gone[3:] else "")
        return self._edit(name, gone, without, f"removed {words}")

    def rename_paint(
        self, name: str, code: str, *, new_code: str = "", new_name: str = ""
    ) -> Generation:
        """Give a paint another code or name; it stays the same paint.

        Raises
        ------
        LibraryError
            When the library has no such paint, or another one has the new code.
        """

        def renamed(block: Block) -> Block:
            place = block.rows.codes.index(code)
            name = new_name or block.rows.names[place]
            rows = replace(
                block.rows,
                codes=_with_text(block.rows.codes, place, new_code or code),
                names=_with_text(block.rows.names, place, name),
            )
            try:
                check(rows, ())
            except RowError as error:
                raise LibraryError(str(error)) from error
            return Block(block.ids, rows)

        change = f"renamed {code} to {' '.join(filter(None, (new_code, new_name)))}"
        free = (new_code,) if new_code and new_code != code else ()
        return self._edit(name, [code], renamed, change, free=free)

    def _edit(
        self,
        name: str,
        codes: list[str],
        change_block: Callable[[Block], Block | None],
        change: str,
        *,
        free: tuple[str, ...] = (),
    ) -> Generation:
        with self._writing() as store:
            head = store.require(name)
            touched = _touched(store.connection, head, codes, free)
            content = store.content(
                head.library_id,
                _edited(store.connection, head, touched, change_block),
            )
            return store.next(head, content=content, change=change)

    def _back_to(
        self,
        store: Change,
        head: Generation,
        goal: Generation,
        change: str,
        *,
        back_id: int | None,
    ) -> Generation:
        others = [one for one in store.heads() if one.library_id != head.library_id]
        if not goal.removed:
            check_name(goal.name, others, self.taken)
        return store.back(head, goal, change, back_id=back_id)

    @contextmanager
    def _writing(self, *, discard: bool = False) -> Iterator[Change]:
        with writing(self.path, discard=discard) as connection:
            yield Change(connection, self.now().isoformat(timespec="seconds"))


def _touched(
    connection: sqlite3.Connection,
    head: Generation,
    codes: list[str],
    free: tuple[str, ...],
) -> set[int]:
    """Ids of the blocks with these codes.

    Raises
    ------
    LibraryError
        When a code is not there, or one is that has to be free.
    """
    found: dict[str, int] = {}
    wanted = {*codes, *free}
    for block_id, texts in block_codes(connection, head):
        found |= dict.fromkeys(wanted.intersection(texts), block_id)
    for code in codes:
        if code not in found:
            msg = (
                f"{head.name} has no paint with the code {code!r}: codes are written "
                "here exactly as in the library"
            )
            raise LibraryError(msg)
    for code in free:
        if code in found:
            msg = f"{head.name} has a paint {code!r} already: choose another code"
            raise LibraryError(msg)
    return set(found.values())


def _edited(
    connection: sqlite3.Connection,
    head: Generation,
    touched: set[int],
    change: Callable[[Block], Block | None],
) -> Iterator[int | Block]:
    angles = len(head.conditions.angles_deg)
    for block_id in block_ids(connection, head):
        if block_id not in touched:
            yield block_id
            continue
        after = change(load_block(connection, block_id, angles))
        if after is not None:
            yield after


def _with_text(texts: tuple[str, ...], place: int, text: str) -> tuple[str, ...]:
    return (*texts[:place], text, *texts[place + 1 :])
