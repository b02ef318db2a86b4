"""The shop's own libraries from the command line."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

from paintlink.cli import main
from paintlink.library import bundled, paint_spec
from paintlink.spec import read_spec_file, write_spec
from tests.cli.conftest import Run
from tests.library.csv_tables import HEADINGS, rows, with_cell, write_csv


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """`paintlink` in this process: these commands leave nothing behind in it."""
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.chdir(tmp_path)

    def go(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        words = [str(one) for one in arguments]
        done = CliRunner().invoke(main, words, catch_exceptions=False)
        return subprocess.CompletedProcess(
            words, done.exit_code, done.stdout, done.stderr
        )

    return go


@pytest.fixture
def table(tmp_path: Path) -> Path:
    return write_csv(tmp_path / "paints.csv", rows(50))


def changed(done: subprocess.CompletedProcess[str]) -> dict[str, object]:
    assert done.returncode == 0, done.stderr
    document: dict[str, object] = json.loads(done.stdout)
    return document


def codes(done: subprocess.CompletedProcess[str]) -> list[str]:
    return [one["code"] for one in json.loads(done.stdout)]


def test_library_is_imported_browsed_and_exported_again(
    run: Run, table: Path, tmp_path: Path
) -> None:
    done = run("library", "import", table, "--into", "Shop")
    assert "Shop: imported 50 paints of paints.csv; generation 1" in done.stdout

    listed = run(
        "library",
        "list",
        "-l",
        "shop",
        "--where",
        "brand=Brand 1",
        "-n",
        "99",
        "--json",
    )
    assert codes(listed) == [f"P{n:05d}" for n in range(1, 51) if n % 4 == 1]

    shown = run("library", "show", "p00007", "-l", "Shop").stdout
    assert "brand: Brand 3" in shown
    assert "real, 45 degree light, D65/10; Shop, generation" in shown

    assert run("library", "export", "-l", "Shop", "again.csv").returncode == 0
    again = changed(
        run("library", "import", "again.csv", "--into", "Shop", "--replace", "--json")
    )
    assert again["number"] == 1  # nothing is different


def test_folder_of_specifications_comes_back_whole(run: Run, tmp_path: Path) -> None:
    small = tmp_path / "small"
    small.mkdir()
    for row in range(0, 6000, 300):
        spec = paint_spec(bundled(), row)
        (small / f"{spec.code}.xml").write_bytes(write_spec(spec))

    run("library", "import", small, "--into", "Copy")
    run("library", "export", "-l", "Copy", "copy")

    (entry,) = (
        one
        for one in json.loads(run("library", "libraries", "--json").stdout)
        if one["own"]
    )
    assert (entry["paints"], entry["synthetic"]) == (20, True)
    for path in small.iterdir():
        assert (tmp_path / "copy" / path.name).read_bytes() == path.read_bytes()


def test_refused_rows_are_listed_and_reported(run: Run, tmp_path: Path) -> None:
    content = rows(50)
    for number in range(0, 50, 2):
        content = with_cell(content, number, "b110", "")
    table = write_csv(tmp_path / "paints.csv", content)

    done = run("library", "import", table, "--into", "Shop", "--report", "why.txt")

    assert done.returncode == 3
    assert "line 2: b at 110 degrees is missing" in done.stderr
    assert "and 5 more; --report FILE names all of them" in done.stderr
    assert "25 refused, the library stays as it was" in done.stderr
    report = (tmp_path / "why.txt").read_text().splitlines()
    assert [line.split(":")[0] for line in report] == [
        f"line {number}" for number in range(2, 52, 2)
    ]
    assert not any(
        one["own"] for one in json.loads(run("library", "libraries", "--json").stdout)
    )


def test_refused_rows_are_told_to_programs(run: Run, tmp_path: Path) -> None:
    table = write_csv(tmp_path / "p.csv", with_cell(rows(9), 4, "L45", "x"))

    done = run("library", "import", table, "--into", "Shop", "--json")

    assert done.returncode == 3
    assert json.loads(done.stdout)["refusals"] == [
        {"place": 6, "what": "L at 45 degrees is no number (found 'x')"}
    ]


def test_dry_run_stores_nothing(run: Run, table: Path) -> None:
    done = run("library", "import", table, "--into", "Shop", "--dry-run")

    assert done.stdout.startswith(
        "dry run, nothing is stored: Shop: imported 50 paints"
    )
    assert run("library", "show", "P00001", "-l", "Shop").returncode == 3


def test_table_of_another_shape_is_mapped(run: Run, tmp_path: Path) -> None:
    table = tmp_path / "odd.csv"
    table.write_bytes(
        "Nr;Farbe;Art;L*(20°);a*(20°);b*(20°);L 45;a 45;b 45;L110;a110;b110\n"
        "7;Grün;Uni;50,5;1;2;50,5;1;2;50,5;1;2\n".encode("cp1252")
    )
    profile = tmp_path / "odd.toml"
    profile.write_text(
        'encoding = "cp1252"\n[columns]\ncode = "Nr"\nL20 = "L*(20°)"\n'
        'a20 = "a*(20°)"\nb20 = "b*(20°)"\n[finishes]\nUni = "solid"\n'
    )

    run(
        "library", "import", table, "--into", "Odd", "--profile", profile,
        "--map", "name=Farbe", "--map", "finish=Art", "--observer", "2",
    )  # fmt: skip

    shown = json.loads(run("library", "show", "7", "-l", "Odd", "--json").stdout)
    assert (shown["name"], shown["finish"], shown["observer"]) == ("Grün", "solid", "2")
    assert [one["aspecular_deg"] for one in shown["samples"]] == [20.0, 45.0, 110.0]
    assert shown["samples"][0]["L"] == 50.5


def test_changes_are_told_and_taken_back(run: Run, table: Path) -> None:
    first = changed(run("library", "import", table, "--into", "Shop", "--json"))
    run("library", "rename", "Shop", "--paint", "P00003", "--code", "Q3", "New name")
    run("library", "remove", "Shop", "P00004", "P00005")
    run("library", "rename", "Shop", "Garage")
    run("library", "remove", "garage")

    assert "Garage" not in run("library", "libraries").stdout
    assert "Garage" in run("library", "libraries", "--removed").stdout
    assert changed(run("library", "undo", "Garage", "--json"))["removed"] is False
    diff = json.loads(run("library", "diff", str(first["generation"]), "--json").stdout)
    assert [one["code"] for one in diff["removed"]] == ["P00004", "P00005"]
    assert [one["code"] for one in diff["changed"]] == ["Q3"]
    assert (
        "code P00003 -> Q3" in run("library", "diff", str(first["generation"])).stdout
    )
    old = run(
        "library", "show", "P00004", "--generation", str(first["generation"])
    ).stdout
    assert f"Shop, generation {first['generation']}" in old
    restored = run("library", "restore", str(first["generation"])).stdout
    assert restored.startswith("Shop: restored generation 1; generation 7")
    assert restored.rstrip().endswith("50 paints")
    history = run("library", "history", "Shop").stdout
    assert all(words in history for words in ("renamed P00003", "took back: removed"))
    assert "no difference" in run("library", "diff", str(first["generation"])).stdout


def test_variants_stand_beside_their_prime(run: Run, tmp_path: Path) -> None:
    table = write_csv(
        tmp_path / "p.csv",
        [
            [*row, group, variant]
            for row, group, variant in zip(
                rows(4),
                ("G1", "G1", "G1", ""),
                ("lighter", "prime", "redder", ""),
                strict=True,
            )
        ],
        headings=[*HEADINGS, "group", "variant"],
    )
    run("library", "import", table, "--into", "Shop")

    shown = json.loads(run("library", "show", "P00003", "-l", "Shop", "--json").stdout)

    group = shown["group"]
    assert [(one["code"], one["variant"]) for one in group] == [
        ("P00002", "prime"), ("P00001", "lighter"), ("P00003", "redder"),
    ]  # fmt: skip
    assert group[0]["dE"] == {"15": 0.0, "45": 0.0, "110": 0.0}
    prime, redder = (
        [[float(cell) for cell in row[at : at + 3]] for at in (3, 6, 9)]
        for row in rows(4)[1:3]
    )
    expected = [
        sum((x - y) ** 2 for x, y in zip(one, other, strict=True)) ** 0.5
        for one, other in zip(prime, redder, strict=True)
    ]
    assert list(group[2]["dE"].values()) == pytest.approx(expected)
    assert "Variants of the prime" in run(
        "library", "show", "P1", "-l", "x"
    ).stderr or (
        "Variants of the prime" in run("library", "show", "P00001", "-l", "Shop").stdout
    )
    alone = run("library", "show", "P00004", "-l", "Shop").stdout
    assert "Variants" not in alone


def test_tree_counts_all_paints(run: Run) -> None:
    document = json.loads(run("library", "tree", "--json").stdout)
    printed = run("library", "tree", "--finish", "pearl").stdout

    leaves = [
        count
        for paint_set in ("solid", "effect")
        for branch in document[paint_set].values()
        for count in branch.values()
    ]
    assert (len(leaves), sum(leaves), document["paints"]) == (14, 6000, 6000)
    assert "  solids: 0" in printed
    assert "      blue: " in printed


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["import", "nowhere.csv", "--into", "X"], 3, "nowhere.csv cannot be read"),
        (["import", ".", "--into", "X"], 3, "has no specification: its files"),
        (
            ["show", "X", "-l", "nope"],
            3,
            "no library 'nope'; there is virtual, munsell",
        ),
        (["show", "X", "--generation", "123"], 3, "no library has a generation '123'"),
        (["remove", "virtual"], 3, "no library of your own is called 'virtual'"),
        (["rename", "Shop"], 2, "say the new name"),
        (
            ["import", "x", "--into", "X", "--map", "code"],
            2,
            "write it as FIELD=HEADING",
        ),
        (
            ["import", "x", "--into", "X", "--map", "cod=Nr"],
            2,
            "there is no field 'cod'",
        ),
        (["import", "x", "--into", "X", "--encoding", "x"], 2, "no encoding 'x'"),
        (["list", "--where", "brand"], 2, "write a condition as column=value"),
        (["export", "exists"], 5, "exists: choose another name"),
        (["export", "nowhere/x.csv"], 5, "choose a folder you may write to"),
        (["diff", "nope"], 3, "there is no library 'nope'"),
    ],
)
def test_what_cannot_be_done_gets_a_next_step(
    run: Run, tmp_path: Path, arguments: list[str], code: int, says: str
) -> None:
    (tmp_path / "exists").mkdir()

    done = run("library", *arguments)

    assert says in done.stderr
    assert done.returncode == code


def test_documents_of_other_conditions_are_refused(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "specs"
    folder.mkdir()
    run("library", "show", "RM209", "-o", "specs/a.xml")
    run("library", "show", "RM331", "-o", "specs/b.xml")
    from dataclasses import replace

    spec = read_spec_file(folder / "a.xml")
    (folder / "c.xml").write_bytes(write_spec(replace(spec, code="C", observer="2")))
    (folder / "d.xml").write_bytes(b"<no/>")
    (folder / "e.xml").write_bytes(write_spec(replace(spec, code="")))
    (folder / "f.xml").write_bytes(
        write_spec(replace(spec, code="F", samples=spec.samples[1::2]))
    )
    (folder / "g.xml").write_bytes(write_spec(spec))

    done = run("library", "import", folder, "--into", "X")

    assert done.returncode == 3
    for says in (
        "c.xml: observer 2 among paints for the 10 degree observer",
        "d.xml: ",
        "e.xml: it has no code",
        "f.xml: no Lab at -15 degrees, which the first paint has",
        "g.xml: the code 'RM209' stands already in a.xml",
    ):
        assert says in done.stderr
    assert "5 refused" in done.stderr


def test_own_library_is_searched_for_the_nearest_paint(run: Run, table: Path) -> None:
    run("library", "import", table, "--into", "Shop")
    run("library", "show", "P00009", "-l", "Shop", "-o", "target.xml")

    found = json.loads(run("snap", "target.xml", "-l", "Shop", "--json").stdout)
    others = json.loads(
        run(
            "snap", "target.xml", "-l", "Shop", "--where", "brand=Brand 2", "--json"
        ).stdout
    )

    best = found["matches"][0]
    assert (best["code"], best["total"], best["library"]) == ("P00009", 0.0, "Shop")
    codes = [one["code"] for one in others["matches"]]
    assert codes
    assert all(int(code[1:]) % 4 == 2 for code in codes)
