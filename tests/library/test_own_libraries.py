"""The shop's own libraries: imports, changes, and that nothing is ever lost."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import ImportRefusedError, LibraryError
from paintlink.library import Filter, bundled, find, paint_spec, parse_choices
from paintlink.library.csv_file import read_csv
from paintlink.library.generations import Generation
from paintlink.library.incoming import Incoming
from paintlink.library.profile import Profile
from paintlink.library.shelf import MUNSELL, VIRTUAL, Shelf
from paintlink.model import PaintTable
from tests.library.csv_tables import HEADINGS, Row, rows, with_cell, write_csv

PAINTS = 5000  # more than one block

Read = Callable[..., Incoming]


@pytest.fixture
def shelf(tmp_path: Path) -> Shelf:
    return Shelf(tmp_path / "state" / "library.db")


@pytest.fixture
def read(tmp_path: Path) -> Read:
    def go(content: list[Row], profile: Profile | None = None, **how: str) -> Incoming:
        path = write_csv(tmp_path / "paints.csv", content, **how)
        return read_csv(path, profile or Profile())

    return go


def codes(table: PaintTable) -> list[str]:
    return list(table.codes)


def equal(one: PaintTable, other: PaintTable) -> bool:
    return (
        one.codes == other.codes
        and one.names == other.names
        and one.finishes == other.finishes
        and np.array_equal(one.ids, other.ids)
        and np.array_equal(one.lab, other.lab)
        and list(one.facets) == list(other.facets)
    )


def test_imported_paints_come_back_as_they_were(shelf: Shelf, read: Read) -> None:
    content = rows(PAINTS)

    made = shelf.editor.import_paints("Shop", read(content))

    table = shelf.table("shop")
    assert (table.library, table.generation) == ("Shop", made.key)
    assert codes(table) == [row[0] for row in content]
    assert table.ids.tolist() == list(range(1, PAINTS + 1))
    assert table.lab.reshape(PAINTS, 9).tolist() == [
        [float(cell) for cell in row[3:12]] for row in content
    ]
    assert table.finishes == tuple(row[2] for row in content)
    assert table.gloss_gu is not None
    assert table.gloss_gu.tolist() == [float(row[12]) for row in content]
    assert (table.observer, table.synthetic) == ("10", False)


def test_further_columns_become_facets(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    table = shelf.table("Shop")

    chosen = Filter(facets=parse_choices(["Brand=brand 2", "year=2000..2001"]))

    assert list(table.facets) == ["brand", "year"]
    expected = [
        row[13] == "Brand 2" and row[14] in {"2000", "2001"} for row in rows(PAINTS)
    ]
    assert chosen.apply(table).tolist() == expected
    assert shelf.extras(table, 7) == {"brand": "Brand 0", "year": "1998"}


def test_paint_becomes_a_specification(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(with_cell(rows(5), 1, "gloss", "")))
    table = shelf.table("Shop")

    first, second = (paint_spec(table, row) for row in (0, 1))

    assert (first.name, first.code) == ("Paint 1", "P00001")
    assert first.gloss is not None
    assert second.gloss is None


def test_libraries_stand_side_by_side(shelf: Shelf, read: Read) -> None:
    assert [one.name for one in shelf.entries()] == [VIRTUAL, MUNSELL]

    shelf.editor.import_paints("Shop", read(rows(3)))
    shelf.editor.import_paints("Lab", read(rows(2)))

    entries = shelf.entries()
    assert [(one.name, one.paints, one.own) for one in entries] == [
        (VIRTUAL, 6000, False), (MUNSELL, 2734, False), ("Lab", 2, True),
        ("Shop", 3, True),
    ]  # fmt: skip
    assert shelf.table() is bundled()
    assert codes(shelf.table("lab")) == ["P00001", "P00002"]


def test_looking_makes_no_file(shelf: Shelf) -> None:
    shelf.entries()
    with pytest.raises(LibraryError, match="no library 'x'; there is virtual, munsell"):
        shelf.table("x")

    assert not shelf.own.path.parent.exists()


def test_code_that_is_there_already_is_refused(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    more = [*with_cell(rows(3), 0, "code", "N1"), ["N2", *rows(1)[0][1:]]]

    with pytest.raises(ImportRefusedError) as caught:
        shelf.editor.import_paints("Shop", read(more))

    assert [str(one) for one in caught.value.refusals] == [
        f"line {line}: the library has the code 'P0000{line - 1}' already: "
        "import with --update"
        for line in (3, 4)
    ]
    assert codes(shelf.table("Shop")) == [row[0] for row in rows(PAINTS)]


def test_update_changes_what_the_file_says_and_keeps_ids(
    shelf: Shelf, read: Read
) -> None:
    shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    before = shelf.table("Shop")
    news = with_cell(rows(PAINTS)[4500:4510], 2, "L45", "44.44")
    news = with_cell(news, 3, "name", "")
    news = with_cell(news, 4, "name", "Other")
    news = with_cell(news, 9, "code", "NEW")

    shelf.editor.import_paints("Shop", read(news[::-1]), "update")

    after = shelf.table("Shop")
    assert codes(after) == [*codes(before), "NEW"]
    assert after.ids.tolist() == list(range(1, PAINTS + 2))
    changed = np.flatnonzero((after.lab[:PAINTS] != before.lab).any(axis=(1, 2)))
    assert changed.tolist() == [4502]
    assert after.lab[4502, 1, 0] == 44.44
    assert after.names[4503:4505] == (before.names[4503], "Other")
    assert after.facets["year"].value(PAINTS) == news[9][14]


def test_update_keeps_columns_the_file_lacks(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(9)))
    fewer = [row[:12] for row in with_cell(rows(2), 0, "L45", "44")]

    shelf.editor.import_paints("Shop", read(fewer, headings=HEADINGS[:12]), "update")

    table = shelf.table("Shop")
    assert table.lab[0, 1, 0] == 44.0
    assert shelf.extras(table, 0) == {"brand": "Brand 1", "year": "1991"}
    assert table.gloss_gu is not None
    assert table.gloss_gu[0] == 81.0


def test_replacing_leaves_what_the_file_holds(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    news = [*rows(PAINTS)[10:4200:2], ["NEW", *rows(1)[0][1:]]]

    shelf.editor.import_paints("Shop", read(news), "replace")

    table = shelf.table("Shop")
    assert codes(table) == [row[0] for row in news]
    assert table.ids.tolist() == [*range(11, 4201, 2), PAINTS + 1]


def test_ids_are_never_given_twice(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(3)))
    shelf.editor.remove_paints("Shop", ["P00003"])

    shelf.editor.import_paints("Shop", read([["NEW", *rows(1)[0][1:]]]))

    assert shelf.table("Shop").ids.tolist() == [1, 2, 4]


def test_import_of_nothing_new_makes_no_generation(shelf: Shelf, read: Read) -> None:
    first = shelf.editor.import_paints("Shop", read(rows(PAINTS)))

    again = [
        shelf.editor.import_paints("Shop", read(rows(PAINTS)), mode)
        for mode in ("update", "replace")
    ]

    assert [one.key for one in again] == [first.key, first.key]


def test_every_generation_can_be_had_again(shelf: Shelf, read: Read) -> None:
    editor = shelf.editor
    made: list[tuple[Generation, PaintTable]] = []

    def note(generation: Generation) -> None:
        made.append((generation, shelf.generation(generation.key)))

    note(editor.import_paints("Shop", read(rows(PAINTS))))
    note(editor.rename_paint("Shop", "P00007", new_code="Q7", new_name="Seven"))
    note(editor.remove_paints("Shop", ["P00008", "P04999"]))
    note(editor.rename("Shop", "Bodyshop"))
    note(editor.remove("Bodyshop"))
    note(editor.import_paints("Shop", read(rows(2))))

    assert len({generation.key for generation, _ in made}) == 6
    for generation, table in made:
        assert equal(shelf.generation(generation.key), table)
        assert table.generation == generation.key
    assert [table.library for _, table in made[:5]] == ["Shop"] * 3 + ["Bodyshop"] * 2
    row = find(made[0][1], "P00007")
    assert made[1][1].codes[row] == "Q7"
    assert made[1][1].ids[row] == made[0][1].ids[row]
    assert "P00008" in made[0][1].codes
    assert "P00008" not in made[2][1].codes


def test_generations_share_what_stayed_the_same(shelf: Shelf, read: Read) -> None:
    import sqlite3

    shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    for number in range(5):
        shelf.editor.rename_paint("Shop", "P00001", new_name=f"Name {number}")
        shelf.editor.rename("Shop", "Other")
        shelf.editor.rename("Other", "Shop")

    with sqlite3.connect(shelf.own.path) as connection:
        (blocks,) = connection.execute("SELECT count(*) FROM blocks").fetchone()
    connection.close()
    assert blocks == 2 + 5


def test_undo_goes_back_step_by_step(shelf: Shelf, read: Read) -> None:
    editor = shelf.editor
    editor.import_paints("Shop", read(rows(10)))
    tables = [shelf.table("Shop")]
    editor.rename_paint("Shop", "P00001", new_code="X")
    tables.append(shelf.table("Shop"))
    editor.import_paints("Shop", read(rows(10)), "update")
    editor.rename("Shop", "Other")
    editor.remove("Other")

    assert editor.undo("Other").change == "took back: removed"
    assert editor.undo("Other").name == "Shop"
    editor.undo("Shop")
    assert equal(shelf.table("Shop"), tables[1])
    editor.undo("Shop")
    assert equal(shelf.table("Shop"), tables[0])
    with pytest.raises(LibraryError, match="Shop: nothing to undo"):
        editor.undo("Shop")
    assert len(shelf.own.history(shelf.own_head("Shop"))) == 9


def test_new_change_after_undo_can_be_undone_too(shelf: Shelf, read: Read) -> None:
    editor = shelf.editor
    editor.import_paints("Shop", read(rows(3)))
    editor.remove_paints("Shop", ["P00001"])
    editor.undo("Shop")
    editor.remove_paints("Shop", ["P00002"])

    editor.undo("Shop")

    assert codes(shelf.table("Shop")) == ["P00001", "P00002", "P00003"]


def test_restored_generation_is_present_again(shelf: Shelf, read: Read) -> None:
    first = shelf.editor.import_paints("Shop", read(rows(3)))
    shelf.editor.remove_paints("Shop", ["P00001"])
    shelf.editor.remove("Shop")

    made = shelf.editor.restore(first.key)

    assert (made.change, made.number) == ("restored generation 1", 4)
    assert codes(shelf.table("Shop")) == ["P00001", "P00002", "P00003"]
    with pytest.raises(LibraryError, match="no library has a generation 'abc'"):
        shelf.editor.restore("abc")


def test_name_of_a_removed_library_is_free(shelf: Shelf, read: Read) -> None:
    old = shelf.editor.import_paints("Shop", read(rows(3)))
    shelf.editor.remove("shop")
    shelf.editor.import_paints("SHOP", read(rows(2)))

    assert [one.name for one in shelf.own.present()] == ["SHOP"]
    assert [one.name for one in shelf.own.removed()] == ["Shop"]
    assert len(shelf.generation(old.key)) == 3
    with pytest.raises(LibraryError, match="there is a library 'Shop' already"):
        shelf.editor.restore(old.key)


@pytest.mark.parametrize("name", ["", "  ", "-x", "a\nb", "x" * 61])
def test_library_needs_a_name_that_can_be_typed(
    shelf: Shelf, read: Read, name: str
) -> None:
    with pytest.raises(LibraryError, match="a library cannot be called"):
        shelf.editor.import_paints(name, read(rows(2)))


def test_name_of_a_bundled_library_is_taken(shelf: Shelf, read: Read) -> None:
    with pytest.raises(LibraryError, match="there is a library 'Virtual' already"):
        shelf.editor.import_paints("Virtual", read(rows(2)))
    with pytest.raises(LibraryError, match="no library of your own is called"):
        shelf.editor.remove(VIRTUAL)


def test_names_of_two_libraries_differ(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(2)))
    shelf.editor.import_paints("Lab", read(rows(2)))

    with pytest.raises(LibraryError, match="there is a library 'SHOP' already"):
        shelf.editor.rename("Lab", "SHOP")
    assert shelf.editor.rename("Lab", "LAB").name == "LAB"


def test_other_observer_is_kept_apart(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(2)))
    two = read([["N", *rows(1)[0][1:]]], Profile(observer="2"))

    with pytest.raises(
        LibraryError,
        match="is for the 2 degree observer, the library Shop for 10 degrees: import "
        "them into a library of their own",
    ):
        shelf.editor.import_paints("Shop", two)

    shelf.editor.import_paints("Shop 2", two)
    assert shelf.table("Shop 2").observer == "2"
    assert len(shelf.table("Shop")) == 2


def test_invented_paints_do_not_come_among_real_ones(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(2)))
    invented = read(
        [["N", *rows(1)[0][1:], "synthetic"]], headings=[*HEADINGS, "origin"]
    )

    with pytest.raises(
        LibraryError, match="holds synthetic paints, the library Shop real"
    ):
        shelf.editor.import_paints("Shop", invented)


def test_paints_without_an_angle_of_the_library_are_refused(
    shelf: Shelf, read: Read
) -> None:
    shelf.editor.import_paints("Shop", read(rows(2)))
    other = [heading.replace("110", "75") for heading in HEADINGS]

    with pytest.raises(LibraryError, match="has no Lab at 110 degrees"):
        shelf.editor.import_paints("Shop", read(rows(5), headings=other), "update")


def test_further_angles_are_left_out(shelf: Shelf, read: Read) -> None:
    shelf.editor.import_paints("Shop", read(rows(2)))
    five = [*HEADINGS, "L25", "a25", "b25", "L75", "a75", "b75"]
    content = [[*rows(3)[2], "1", "2", "3", "4", "5", "6"]]

    shelf.editor.import_paints("Shop", read(content, headings=five))

    table = shelf.table("Shop")
    assert table.angles_deg == (15.0, 45.0, 110.0)
    assert table.lab[2].ravel().tolist() == [float(cell) for cell in rows(3)[2][3:12]]


def test_diff_names_what_came_went_and_changed(shelf: Shelf, read: Read) -> None:
    old = shelf.editor.import_paints("Shop", read(rows(PAINTS)))
    news = with_cell(rows(PAINTS), 4700, "L110", "50")
    news = with_cell(news, 3, "year", "1900")
    news = [*news[:10], *news[11:], ["NEW", *rows(1)[0][1:]]]
    shelf.editor.import_paints("Shop", read(news), "replace")
    new = shelf.editor.rename_paint("Shop", "P00005", new_code="Q5")

    found = shelf.own.difference(old, new)

    assert [one.code for one in found.added] == ["NEW"]
    assert [one.code for one in found.removed] == ["P00011"]
    assert [(one.code, one.fields) for one in found.changed] == [
        ("P00004", (("year", "1994", "1900"),)),
        ("Q5", (("code", "P00005", "Q5"),)),
        ("P04701", ()),
    ]
    lightness = float(rows(PAINTS)[4700][9])
    assert found.changed[2].differences == pytest.approx((
        0.0,
        0.0,
        abs(50.0 - lightness),
    ))
    assert len(shelf.own.difference(old, old)) == 0


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda e: e.remove_paints("Shop", ["P1", "x"]), "no paint with the code 'P1'"),
        (lambda e: e.rename_paint("Shop", "x", new_name="y"), "with the code 'x'"),
        (
            lambda e: e.rename_paint("Shop", "P00001", new_code="P00002"),
            "has a paint 'P00002' already",
        ),
        (
            lambda e: e.rename_paint("Shop", "P00001", new_code="\n"),
            "control character",
        ),
        (
            lambda e: e.remove_paints("Shop", ["P00001", "P00002"]),
            "nothing would be left in the library: remove the library itself",
        ),
        (lambda e: e.rename("Shop", VIRTUAL), "there is a library 'virtual' already"),
    ],
)
def test_change_that_cannot_be_made_changes_nothing(
    shelf: Shelf, read: Read, change: Callable[..., object], why: str
) -> None:
    made = shelf.editor.import_paints("Shop", read(rows(2)))

    with pytest.raises(LibraryError, match=why):
        change(shelf.editor)

    assert shelf.own_head("Shop") == made


def test_unknown_generation_is_named(shelf: Shelf) -> None:
    with pytest.raises(LibraryError, match="no library has a generation 'abc'"):
        shelf.generation("abc")
    assert shelf.generation(bundled().generation) is bundled()
