"""`paintlink snap` as a user runs it."""

from __future__ import annotations

import csv
import io
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from paintlink.library import bundled, find, paint_spec
from paintlink.spec import write_spec
from tests.cli.conftest import Run
from tests.snap.conftest import STANDARD, make_target


def design(lab: np.ndarray, path: Path) -> Path:
    path.write_bytes(write_spec(make_target(lab)))
    return path


def rm209() -> np.ndarray:
    table = bundled()
    return paint_spec(table, find(table, "RM209")).lab(*STANDARD)


def test_snap_ranks_and_states_its_conditions(run: Run, spec_file: Path) -> None:
    done = run("snap", spec_file, "-k", "3", "--json")

    matches = json.loads(done.stdout)["matches"]
    totals = [match["total"] for match in matches]
    assert totals == sorted(totals)
    assert len(totals) == 3
    assert matches[0]["angles_deg"] == [15.0, 45.0, 110.0]
    assert matches[0]["formula"] == "cie76"
    assert matches[0]["observer"] == "10"
    assert "synthetic" in matches[0]["library"]


def test_snap_table_says_where_it_comes_from(run: Run, spec_file: Path) -> None:
    done = run("snap", spec_file)

    assert "cie76, sum over 15/45/110 degrees, D65/10" in done.stdout
    assert "synthetic" in done.stdout
    assert "Starting points for 'grey'" in done.stdout


def test_snap_filter_keeps_only_that_finish(run: Run, spec_file: Path) -> None:
    done = run("snap", spec_file, "--finish", "pearl", "--json")

    assert {match["finish"] for match in json.loads(done.stdout)["matches"]} == {
        "pearl"
    }


def test_snap_with_unknown_formula_lists_them(run: Run, spec_file: Path) -> None:
    done = run("snap", spec_file, "--metric", "dE3000")

    assert done.returncode == 3
    assert "unknown difference formula 'dE3000'" in done.stderr
    assert "ciede2000" in done.stderr


def test_snap_says_what_is_wrong_with_a_design(run: Run, tmp_path: Path) -> None:
    path = design(rm209() * (1.0, 1.35, 1.35), tmp_path / "deep red.xml")

    done = run("snap", path)

    assert "! the colour is too chromatic: RM209 has the hue, but lacks" in done.stdout
    assert "Lab units outside all colours of" in done.stdout
    assert "RM209 stays first in 100% of readings" in done.stdout
    assert "by ciede2000" in done.stdout


def test_limits_of_the_configuration_decide_what_is_told(
    run: Run, tmp_path: Path
) -> None:
    path = design(rm209() * (1.0, 1.35, 1.35), tmp_path / "deep red.xml")
    config = tmp_path / "own.toml"
    config.write_text("[snap]\ntoo_chromatic = 60.0\noutside = 60.0\nsparse = 60.0\n")

    done = run("snap", path, "--config", config, "--json")

    findings = json.loads(done.stdout)["findings"]
    assert {one["limit"] for one in findings if one["kind"] == "outside"} == {60.0}
    assert not any(one["told"] for one in findings)


def test_instrument_with_other_angles_gets_an_estimate(
    run: Run, tmp_path: Path
) -> None:
    angles = (20.0, 45.0, 80.0)
    spec = make_target(rm209(), angles_deg=angles)
    (tmp_path / "other.xml").write_bytes(write_spec(spec))

    done = run("snap", "other.xml")

    assert "estimated: the library is interpolated at 20/80 degrees" in done.stdout


def test_angles_can_be_chosen(run: Run, tmp_path: Path) -> None:
    table = bundled()
    spec = paint_spec(table, find(table, "RM209"))
    (tmp_path / "six.xml").write_bytes(write_spec(spec))

    done = run("snap", "six.xml", "--angles", "25/45/75", "--json")
    wrong = run("snap", "six.xml", "--angles", "near,far")

    assert json.loads(done.stdout)["matches"][0]["angles_deg"] == [25.0, 45.0, 75.0]
    assert wrong.returncode == 2
    assert "write numbers with commas between" in wrong.stderr


@pytest.mark.parametrize(
    ("name", "start"), [("g.png", b"\x89PNG"), ("g.svg", b"<?xml"), ("g.json", b"{")]
)
def test_graph_is_written_in_the_format_of_its_name(
    run: Run, tmp_path: Path, spec_file: Path, name: str, start: bytes
) -> None:
    done = run("snap", spec_file, "--graph", name)

    assert done.returncode == 0
    assert (tmp_path / name).read_bytes().startswith(start)
    assert f"wrote {name}" in done.stderr


def test_graph_in_another_format_is_refused(run: Run, spec_file: Path) -> None:
    done = run("snap", spec_file, "--graph", "g.bmp")

    assert done.returncode == 2
    assert "the graph is PNG, SVG or JSON" in done.stderr


def table_of(tmp_path: Path, rows: int) -> Path:
    rng = np.random.default_rng(1)
    book = bundled()
    columns = [book.angles_deg.index(angle) for angle in STANDARD]
    lab = book.lab[:rows, columns] + rng.normal(0.0, 0.05, (rows, 3, 3))
    lines = ["code,L15,a15,b15,L45,a45,b45,L110,a110,b110"]
    for number, colour in enumerate(lab):
        values = ",".join(f"{value:.3f}" for value in colour.ravel())
        lines.append(f"T{number},{values}")
    path = tmp_path / "targets.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_table_of_targets_gives_a_table_of_lists(run: Run, tmp_path: Path) -> None:
    done = run("snap", table_of(tmp_path, 300), "-k", "2", "-o", "lists.csv")

    with (tmp_path / "lists.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    firsts = [row["code"] for row in rows if row["rank"] == "1"]
    assert done.returncode == 0
    assert "300 of 300 targets compared" in done.stderr
    assert len(rows) == 600
    assert rows[0]["target"] == "T0"
    assert np.mean(np.array(firsts) == np.array(bundled().codes[:300])) > 0.97
    total = sum(float(rows[0][f"dE_{angle:g}"]) for angle in STANDARD)
    assert float(rows[0]["total"]) == total


def test_table_gives_what_single_targets_give(run: Run, tmp_path: Path) -> None:
    done = run("snap", table_of(tmp_path, 3), "-k", "4", "--json")

    documents = [json.loads(line) for line in done.stdout.splitlines()]
    lines = (tmp_path / "targets.csv").read_text().splitlines()
    values = np.array([float(v) for v in lines[2].split(",")[1:]]).reshape(3, 3)
    single = run("snap", design(values, tmp_path / "one.xml"), "-k", "4", "--json")
    expected = json.loads(single.stdout)["matches"]
    assert [one["target"] for one in documents] == ["T0", "T1", "T2"]
    assert [(m["code"], m["total"]) for m in documents[1]["matches"]] == [
        (m["code"], m["total"]) for m in expected
    ]


def test_folder_tells_what_it_could_not_use(
    run: Run, tmp_path: Path, spec_file: Path
) -> None:
    folder = tmp_path / "specs"
    folder.mkdir()
    shutil.copy(spec_file, folder / "a.xml")
    shutil.copy(spec_file, folder / "c.xml")
    (folder / "b.xml").write_text("<colorSpec")

    done = run("snap", folder, "-k", "1")

    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    assert [row["target"] for row in rows] == ["a", "c"]
    assert done.returncode == 3
    assert "2 of 3 targets compared" in done.stderr
    assert "1 of 3 targets were left out" in done.stderr
    assert "b.xml" in done.stderr


def test_empty_folder_is_refused(run: Run, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()

    done = run("snap", "empty")

    assert done.returncode == 3
    assert "empty holds no specification" in done.stderr


def test_output_that_cannot_be_written_leaves_nothing(run: Run, tmp_path: Path) -> None:
    done = run("snap", table_of(tmp_path, 3), "-o", "nowhere/lists.csv")

    assert done.returncode == 5
    assert "nowhere/lists.csv" in done.stderr


@pytest.mark.parametrize(
    "arguments", [("--graph", "g.png"), ("-o", "out.csv")], ids=["many", "one"]
)
def test_options_of_the_other_mode_are_refused(
    run: Run, tmp_path: Path, spec_file: Path, arguments: tuple[str, str]
) -> None:
    target = table_of(tmp_path, 2) if arguments[0] == "--graph" else spec_file

    done = run("snap", target, *arguments)

    assert done.returncode == 2
    assert "target" in done.stderr


def test_several_libraries_give_one_list(run: Run, tmp_path: Path) -> None:
    table = bundled()
    rows = ["code,name,L15,a15,b15,L45,a45,b45,L110,a110,b110"]
    for code, step in (("OWN1", 0.02), ("OWN2", 30.0)):
        values = ",".join(f"{value:.2f}" for value in (rm209() + step).ravel())
        rows.append(f"{code},Own paint,{values}")
    (tmp_path / "own.csv").write_text("\n".join(rows) + "\n")
    run("library", "import", "own.csv", "--into", "Shop")
    spec = paint_spec(table, find(table, "RM209"), angles_deg=STANDARD)
    (tmp_path / "rm209.xml").write_bytes(write_spec(spec))

    told = run("snap", "rm209.xml", "-l", "virtual", "-l", "Shop", "-k", "3")
    done = run("snap", "rm209.xml", "-l", "virtual", "-l", "Shop", "-k", "3", "--json")

    matches = json.loads(done.stdout)["matches"]
    assert [m["code"] for m in matches[:2]] == ["RM209", "OWN1"]
    assert matches[1]["library"] == "Shop"
    assert [m["second_rank"] for m in matches[:2]] == [1, 2]
    assert "Shop, generation" in told.stdout
    assert "Virtual 6000 (synthetic), generation" in told.stdout


def test_table_of_targets_wants_one_library(run: Run, tmp_path: Path) -> None:
    done = run("snap", table_of(tmp_path, 2), "-l", "virtual", "-l", "munsell")

    assert done.returncode == 2
    assert "are compared with one library" in done.stderr
