"""Browsing the library from the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from paintlink.library import bundled
from paintlink.spec import read_spec_file
from tests.cli.conftest import Run


def test_stats_count_every_paint_in_its_drawer(run: Run) -> None:
    document = json.loads(run("library", "stats", "--json").stdout)
    printed = run("library", "stats").stdout

    counts = [count for _, _, count in document["drawers"]]
    assert (len(counts), sum(counts)) == (14, 6000)
    assert document["synthetic"] is True
    assert document["by_finish"]["solid"] == 3000
    assert all(str(count) in printed for count in counts)
    assert "synthetic" in printed


def test_list_narrows_by_text_finish_and_index(run: Run) -> None:
    done = run(
        "library", "list", "ruby", "--finish", "pearl", "--drawer", "red",
        "--flop", "7.0", "7.4", "-n", "500", "--json",
    )  # fmt: skip

    paints = json.loads(done.stdout)
    assert paints
    assert all("Ruby" in paint["name"] for paint in paints)
    assert {paint["finish"] for paint in paints} == {"pearl"}
    assert all(7.0 <= paint["flop_index"] <= 7.4 for paint in paints)


def test_list_says_how_many_more_there_are(run: Run) -> None:
    done = run("library", "list", "--finish", "solid", "-n", "3")

    assert "3 of 3000 paints" in done.stdout


def test_show_prints_the_colour_at_every_angle(run: Run) -> None:
    done = run("library", "show", "YM144")

    table = bundled()
    lab = table.lab[table.codes.index("YM144")]
    assert all(f"{L:7.2f} {a:7.2f} {b:7.2f}" in done.stdout for L, a, b in lab)
    assert "hue shift index 12.6" in done.stdout


def test_shown_paint_can_be_used_as_a_specification(run: Run, tmp_path: Path) -> None:
    run("library", "show", "GM027", "-o", "green.xml")
    snapped = run("snap", "green.xml", "-k", "1", "--json")

    assert read_spec_file(tmp_path / "green.xml").code == "GM027"
    (match,) = json.loads(snapped.stdout)["matches"]
    assert (match["code"], match["total"]) == ("GM027", 0.0)


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["show", "YM1444"], 3, "did you mean"),
        (["list", "--flop", "99", "100"], 3, "flop index 99 to 100: widen it"),
        (["list", "--drawer", "pink"], 2, "no drawer 'pink': take blue, green"),
    ],
)
def test_what_is_not_there_gets_a_next_step(
    run: Run, arguments: list[str], code: int, says: str
) -> None:
    done = run("library", *arguments)

    assert done.returncode == code
    assert says in done.stderr


def test_show_prints_formula_and_variants(run: Run) -> None:
    from paintlink.library.virtual import book

    table = bundled()
    row = next(row for row in range(6000) if len(book().group(row)) > 2)
    code = table.codes[row]

    shown = json.loads(run("library", "show", code, "--json").stdout)
    printed = run("library", "show", code).stdout

    assert sum(one["parts"] for one in shown["formula"]) == pytest.approx(100.0)
    assert {one["code"] for one in shown["group"]} == {
        table.codes[member] for member in book().group(row)
    }
    assert shown["group"][0]["variant"] == "prime"
    assert all(one["code"] in printed for one in (*shown["formula"], *shown["group"]))


def test_variants_can_be_listed(run: Run) -> None:
    from paintlink.library.virtual import book

    done = run("library", "list", "--where", "variant=redder", "-n", "9999", "--json")

    found = {one["code"] for one in json.loads(done.stdout)}
    assert found == {
        code for row, code in enumerate(bundled().codes) if book().role(row) == "redder"
    }
    assert found
