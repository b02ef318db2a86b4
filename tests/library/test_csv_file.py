from __future__ import annotations

import codecs
from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import ImportRefusedError, LibraryError
from paintlink.library.csv_file import read_csv
from paintlink.library.incoming import MAX_REFUSALS, Incoming
from paintlink.library.profile import Profile
from tests.library.csv_tables import HEADINGS, Row, a_row, rows, with_cell, write_csv


def refusals(path: Path, profile: Profile | None = None) -> list[str]:
    with pytest.raises(ImportRefusedError) as caught:
        read_csv(path, profile or Profile())
    return [str(refusal) for refusal in caught.value.refusals]


def cells(incoming: Incoming) -> list[Row]:
    """What was read, as it stood in the file."""
    return [
        [
            block.codes[i], block.names[i], block.finishes[i],
            *(f"{value:.2f}" for value in block.lab[i].ravel()),
            f"{block.gloss_gu[i]:g}", block.extras["brand"][i], block.extras["year"][i],
        ]
        for block in incoming.blocks
        for i in range(len(block))
    ]  # fmt: skip


def test_every_cell_arrives_where_it_belongs(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "paints.csv", rows(9000))

    found = read_csv(path)

    assert cells(found) == rows(9000)
    assert found.conditions.angles_deg == (15.0, 45.0, 110.0)
    assert (found.conditions.observer, found.conditions.synthetic) == ("10", False)
    assert len(found.blocks) == 3


def test_order_of_columns_does_not_matter(tmp_path: Path) -> None:
    shuffled = [row[::-1] for row in rows(50)]
    path = write_csv(tmp_path / "p.csv", shuffled, headings=HEADINGS[::-1])

    assert cells(read_csv(path)) == rows(50)


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le-bom", "cp1252"]
)
def test_delimiter_and_marked_encoding_are_seen(
    tmp_path: Path, delimiter: str, encoding: str
) -> None:
    content = with_cell(rows(3), 1, "name", "Grün métal")
    plain = encoding.removesuffix("-bom")
    path = write_csv(tmp_path / "p.csv", content, delimiter=delimiter, encoding=plain)
    if plain != encoding:
        path.write_bytes(codecs.BOM_UTF16_LE + path.read_bytes())
    profile = Profile(encoding="cp1252" if encoding == "cp1252" else "")

    assert cells(read_csv(path, profile)) == content


def test_decimal_commas_are_seen(tmp_path: Path) -> None:
    table = rows(20)
    commas = [[*row[:3], *(c.replace(".", ",") for c in row[3:])] for row in table]

    path = write_csv(tmp_path / "p.csv", commas, delimiter=";")

    assert cells(read_csv(path)) == table


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_lines_are_counted_however_they_end(tmp_path: Path, newline: str) -> None:
    content = with_cell(rows(30), 20, "L45", "dark")
    path = write_csv(tmp_path / "p.csv", content)
    path.write_bytes(path.read_bytes().replace(b"\n", newline.encode()))

    assert refusals(path) == ["line 22: L at 45 degrees is no number (found 'dark')"]


def test_lines_inside_of_quotes_and_blank_ones_are_counted(tmp_path: Path) -> None:
    content = with_cell(rows(30), 4, "brand", '"two\nlines"')
    content = with_cell(content, 20, "L45", "")
    path = write_csv(tmp_path / "p.csv", content)
    path.write_text(path.read_text().replace("P00011", "\n\nP00011"))

    assert refusals(path)[0].startswith("line 25: L at 45 degrees is missing")


@pytest.mark.parametrize(
    ("heading", "text", "why"),
    [
        ("a110", "", "a at 110 degrees is missing: measure it, or leave the paint out"),
        ("b15", "n/a", "b at 15 degrees is no number (found 'n/a')"),
        ("b15", "1_0", "b at 15 degrees is no number (found '1_0')"),
        ("L15", "nan", "L at 15 degrees must lie between -16 and 170 (found nan)"),
        ("L15", "inf", "L at 15 degrees must lie between -16 and 170 (found inf)"),
        ("L45", "6012", "(found 6012): check the units and the order of columns"),
        ("gloss", "-3", "the gloss must lie between 0 and 2000 (found -3)"),
        ("finish", "matt", "one of solid, metallic, pearl, unknown (found 'matt')"),
        ("code", " ", "it has no code: give every paint one"),
        ("code", "P00003", "the code 'P00003' stands already on line 4: keep one"),
        ("code", "x" * 65, "the code is longer than 64 characters (found 65)"),
        ("name", "bell\x07", "the name holds the control character '\\x07': remove it"),
        ("name", "nul\x00", "the name holds the control character '\\x00': remove it"),
    ],
)
def test_refused_row_is_named_with_line_and_reason(
    tmp_path: Path, heading: str, text: str, why: str
) -> None:
    path = write_csv(tmp_path / "p.csv", with_cell(rows(4200), 4180, heading, text))

    (found,) = refusals(path)

    assert found.startswith("line 4182: ")
    assert why in found


def test_all_refused_rows_are_found_in_one_go(tmp_path: Path) -> None:
    content = rows(9000)
    for number in (0, 17, 4095, 4096, 8999):
        content = with_cell(content, number, "L45", "?")
    path = write_csv(tmp_path / "p.csv", content)

    lines = [text.partition(":")[0] for text in refusals(path)]

    assert lines == ["line 2", "line 19", "line 4097", "line 4098", "line 9001"]


@pytest.mark.parametrize(("change", "cells_found"), [(slice(0, -1), 14), (None, 16)])
def test_row_of_another_width_is_refused(
    tmp_path: Path, change: slice | None, cells_found: int
) -> None:
    content = rows(10)
    content[6] = content[6][change] if change else [*content[6], "more"]
    path = write_csv(tmp_path / "p.csv", content)

    assert refusals(path) == [
        f"line 8: it has {cells_found} cells where the heading has 15"
    ]


def test_wrong_file_is_not_read_to_its_end(tmp_path: Path) -> None:
    content = [[*row[:3], "x", *row[4:]] for row in rows(3000)]
    path = write_csv(tmp_path / "p.csv", content)

    with pytest.raises(ImportRefusedError, match="at least 1000 refused") as caught:
        read_csv(path)
    assert len(caught.value.refusals) == MAX_REFUSALS


def test_fractions_are_told_from_lab(tmp_path: Path) -> None:
    content = [
        [*row[:3], *(f"{float(c) / 130:.4f}" for c in row[3:12]), *row[12:]]
        for row in rows(5)
    ]
    path = write_csv(tmp_path / "p.csv", content)

    (found,) = refusals(path)

    assert "no L* is above 1: these are fractions" in found


HEAD_15 = [*HEADINGS, "observer", "illuminant", "origin"]


@pytest.mark.parametrize(
    ("conditions", "why"),
    [
        (("2", "D65", ""), "observer '2' among paints for the 10 degree observer"),
        (("10", "A", ""), "illuminant 'A': a library holds Lab for D65 only"),
        (("10", "D65", "synthetic"), "origin 'synthetic' among real paints"),
        (("?", "D65", ""), "observer '?' among paints for the 10 degree observer"),
    ],
)
def test_other_conditions_are_never_mixed(
    tmp_path: Path, conditions: tuple[str, ...], why: str
) -> None:
    content = [[*row, "10°", "D65", "real"] for row in rows(9)]
    content[5][-3:] = conditions
    path = write_csv(tmp_path / "p.csv", content, headings=HEAD_15)

    (found,) = refusals(path)

    assert found.startswith("line 7: ")
    assert why in found


def test_conditions_of_the_table_are_kept(tmp_path: Path) -> None:
    content = [[*row, "D65/2", "D65", "Simulated"] for row in rows(9)]
    path = write_csv(tmp_path / "p.csv", content, headings=HEAD_15)

    conditions = read_csv(path).conditions

    assert (conditions.observer, conditions.synthetic) == ("2", True)


def test_profile_says_the_observer_of_a_table_without_one(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", rows(9))

    assert read_csv(path, Profile(observer="2")).conditions.observer == "2"


def test_lines_in_another_encoding_are_named(tmp_path: Path) -> None:
    content = with_cell(rows(5000), 4500, "name", "Grün")
    path = write_csv(tmp_path / "p.csv", content, encoding="cp1252")

    assert refusals(path) == [
        "line 4502: not in the encoding utf-8: say how the file is written, such as "
        "--encoding cp1252"
    ]


def test_broken_utf16_is_refused(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", rows(5), encoding="utf-16")
    path.write_bytes(path.read_bytes()[:-1])

    with pytest.raises(LibraryError, match="is not in the encoding utf-16"):
        read_csv(path)


def test_quote_that_is_never_closed_is_named(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", with_cell(rows(5000), 4500, "name", '"open'))

    (found,) = refusals(path)

    assert "no CSV from here on" in found
    assert "close the quotes" in found


def test_rows_before_broken_csv_are_checked_as_well(tmp_path: Path) -> None:
    content = with_cell(rows(50), 40, "name", '"open')
    path = write_csv(tmp_path / "p.csv", with_cell(content, 3, "L45", "?"))

    first, second = refusals(path)

    assert first.startswith("line 5: L at 45")
    assert "no CSV" in second


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "no column holds the code"),
        (b"code,name\n", "Lab is needed at 3, 5 or 6 aspecular angles"),
        (b"code,L15,a15,b15,L45,a45\n", "no column holds b at 45 degrees"),
        (b"code,code\n", "the heading 'code' stands twice"),
        (b'"code\n', "line 1 is no heading of a CSV table"),
        (b"\x89PNG\r\n\x1a\n\x00\x00", "not in the encoding"),
    ],
)
def test_file_that_is_no_table_of_paints_is_refused(
    tmp_path: Path, content: bytes, why: str
) -> None:
    path = tmp_path / "p.csv"
    path.write_bytes(content)

    with pytest.raises(LibraryError, match=why):
        read_csv(path)


def test_table_without_rows_holds_no_paint(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", [])

    assert refusals(path) == [f"{path}: it holds no paint"]


@pytest.mark.parametrize("name", ["missing.csv", "."])
def test_what_is_no_file_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(LibraryError, match="cannot be read: "):
        read_csv(tmp_path / name)


def test_progress_ends_at_the_whole_file(tmp_path: Path) -> None:
    told: list[float] = []

    read_csv(write_csv(tmp_path / "p.csv", rows(9000)), progress=told.append)

    assert told == sorted(told)
    assert (len(told), told[-1]) == (18, 1.0)


def test_minus_zero_is_zero(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", with_cell(rows(3), 0, "a15", "-0.00"))

    lab = read_csv(path).blocks[0].lab

    assert not np.signbit(lab[0, 0, 1])


def test_paint_without_gloss_has_none(tmp_path: Path) -> None:
    path = write_csv(tmp_path / "p.csv", with_cell(rows(3), 0, "gloss", ""))

    assert np.isnan(read_csv(path).blocks[0].gloss_gu).tolist() == [True, False, False]


def test_rows_read_alone_equal_rows_read_together(tmp_path: Path) -> None:
    """Halving a block to find a refused row changes nothing about the others."""
    content = [a_row(number) for number in range(1, 100)]
    path = write_csv(tmp_path / "p.csv", content)
    alone = [write_csv(tmp_path / f"{i}.csv", [row]) for i, row in enumerate(content)]

    assert cells(read_csv(path)) == [cells(read_csv(one))[0] for one in alone]
