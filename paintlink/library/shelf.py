"""All libraries side by side: those that come with paintlink, and the shop's own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from paintlink.errors import LibraryError
from paintlink.library.diff import Difference
from paintlink.library.editing import Editor
from paintlink.library.generations import Generation
from paintlink.library.renotation import munsell
from paintlink.library.rows import Conditions
from paintlink.library.stored import StoredLibraries
from paintlink.library.virtual import bundled
from paintlink.model import PaintTable

VIRTUAL, MUNSELL = "virtual", "munsell"


@dataclass(frozen=True, slots=True)
class BuiltIn:
    """A library that comes with paintlink: a short name, and how it is had."""

    name: str
    load: Callable[[], PaintTable]


BUILT_IN = (BuiltIn(VIRTUAL, bundled), BuiltIn(MUNSELL, munsell))


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A library on the shelf.

    ``change`` and ``made_at`` tell about the last change of an own library; those that
    come with paintlink cannot be changed.
    """

    name: str
    title: str
    own: bool
    paints: int
    generation: str
    conditions: Conditions
    change: str = ""
    made_at: str = ""


class Shelf:
    """The libraries somebody can choose from.

    Parameters
    ----------
    path
        The file of the shop's own libraries, which need not be there yet.
    """

    def __init__(self, path: Path) -> None:
        self.own = StoredLibraries(path)
        self.editor = Editor(path, taken=tuple(one.name for one in BUILT_IN))

    def entries(self) -> tuple[Entry, ...]:
        """All libraries, those that come with paintlink first."""
        built_in = (_built_in_entry(one) for one in BUILT_IN)
        return (*built_in, *map(own_entry, self.own.present()))

    def table(self, name: str = VIRTUAL) -> PaintTable:
        """The paints of the library of this name, in any case.

        Raises
        ------
        LibraryError
            When there is none; names those there are.
        """
        folded = name.casefold()
        for one in BUILT_IN:
            if one.name == folded:
                return one.load()
        return self.own.table(self.own_head(name))

    def own_head(self, name: str) -> Generation:
        """The present generation of the shop's own library of this name.

        Raises
        ------
        LibraryError
            When there is none, or it comes with paintlink.
        """
        present = {one.name.casefold(): one for one in self.own.present()}
        found = present.get(name.casefold())
        if found is None:
            names = [
                *(one.name for one in BUILT_IN),
                *(p.name for p in present.values()),
            ]
            msg = f"there is no library {name!r}; there is {', '.join(names)}"
            raise LibraryError(msg)
        return found

    def generation(self, key: str) -> PaintTable:
        """The paints of a generation that a match or a job names, however old.

        Raises
        ------
        LibraryError
            When no library on this computer was ever in this state.
        """
        for one in BUILT_IN:
            if one.load().generation == key:
                return one.load()
        found = self.own.generation(key)
        if found is None:
            msg = (
                f"no library has a generation {key!r}: it belongs to another computer, "
                "or to a library of another version of paintlink"
            )
            raise LibraryError(msg)
        return self.own.table(found)

    def difference(self, old: str, new: str = "") -> Difference:
        """What changed between two generations of one of the shop's own libraries.

        Parameters
        ----------
        old
            Key of a generation, or name of a library for the generation before its
            present one.
        new
            Key of a generation; empty for the present one.

        Raises
        ------
        LibraryError
            When a generation is unknown, or the two belong to different libraries.
        """
        before = self.own.generation(old)
        if before is None:
            past = self.own.history(self.own_head(old))
            before = past[-2] if len(past) > 1 else past[-1]
        after = self.own.generation(new) if new else self.own.history(before)[-1]
        if after is None:
            msg = f"no library has a generation {new!r}: `paintlink library history`"
            raise LibraryError(msg)
        if before.library_id != after.library_id:
            msg = (
                f"{old} belongs to the library {before.name}, {new} to {after.name}: "
                "name two generations of one library"
            )
            raise LibraryError(msg)
        return self.own.difference(before, after)

    def specifications(self, table: PaintTable) -> Sequence[str]:
        """The document each paint was imported from, empty where there is none."""
        stored = self.own.generation(table.generation)
        return self.own.specifications(stored) if stored else ("",) * len(table)

    def extras(self, table: PaintTable, row: int) -> dict[str, str]:
        """Every further column of one paint, such as brand or formula."""
        stored = self.own.generation(table.generation)
        if stored is not None:
            return self.own.extras(stored, int(table.ids[row]))
        values = {name: facet.value(row) for name, facet in table.facets.items()}
        return {name: value for name, value in values.items() if value}


def own_entry(generation: Generation) -> Entry:
    """The shop's own library in this generation."""
    return Entry(
        name=generation.name,
        title=generation.name,
        own=True,
        paints=generation.paints,
        generation=generation.key,
        conditions=generation.conditions,
        change=generation.change,
        made_at=generation.made_at,
    )


def _built_in_entry(one: BuiltIn) -> Entry:
    table = one.load()
    return Entry(
        name=one.name,
        title=table.library,
        own=False,
        paints=len(table),
        generation=table.generation,
        conditions=Conditions(
            angles_deg=table.angles_deg,
            observer=table.observer,
            synthetic=table.synthetic,
        ),
    )
