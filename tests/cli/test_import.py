"""`paintlink import` as a user runs it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from paintlink.spec import read_spec_file
from tests.cli.conftest import Run
from tests.intake.fixtures.csv_table import wide
from tests.intake.fixtures.mat12_xlsx import book, document, saved


@pytest.fixture
def workbook(tmp_path: Path) -> Path:
    """A workbook of two readings under a name that tells nothing."""
    path = tmp_path / "readings.dat"
    path.write_bytes(document())
    return path


def test_dry_run_tells_what_a_file_holds_and_stores_nothing(
    run: Run, workbook: Path
) -> None:
    done = run("import", "--dry-run", workbook)

    assert done.returncode == 0
    assert "Basalt 7   -15/15/25/45/75/110   can be imported" in done.stdout
    assert "No jobs yet" in run("jobs", "list").stdout


def test_imported_readings_go_down_the_line(run: Run, workbook: Path) -> None:
    done = run("import", workbook, "--json")

    assert done.returncode == 0
    (report,) = json.loads(done.stdout)
    assert report["format"] == "mat12_xlsx"
    tokens = [one["job"] for one in report["colours"]]
    assert all(one["nearest"] and one["total"] > 0 for one in report["colours"])
    jobs = json.loads(run("jobs", "list", "--json").stdout)
    assert {job["job"] for job in jobs} == set(tokens)
    assert all(job["state"] == "done" and job["matches"] for job in jobs)


def test_same_file_again_imports_nothing(run: Run, workbook: Path) -> None:
    run("import", workbook)

    again = run("import", workbook)

    assert again.returncode == 0
    assert "imported before as readings.dat" in again.stdout
    assert len(json.loads(run("jobs", "list", "--json").stdout)) == 2


def test_same_readings_in_another_file_import_once(
    run: Run, workbook: Path, tmp_path: Path
) -> None:
    run("import", workbook)
    other = tmp_path / "more.xlsx"
    other.write_bytes(saved(book(("Basalt 7", "Basalt 8", "Basalt 9"))))

    run("import", other)

    assert len(json.loads(run("jobs", "list", "--json").stdout)) == 3


def test_specifications_are_written_into_a_folder(
    run: Run, workbook: Path, tmp_path: Path
) -> None:
    done = run("import", workbook, "--to", "colours", "--finish", "metallic")

    assert done.returncode == 0
    specs = [read_spec_file(path) for path in (tmp_path / "colours").iterdir()]
    assert {spec.name for spec in specs} == {"Basalt 7", "Basalt 8"}
    assert {spec.finish for spec in specs} == {"metallic"}
    assert "No jobs yet" in run("jobs", "list").stdout


def test_refused_file_leaves_the_others_and_the_exit_code(
    run: Run, workbook: Path, tmp_path: Path
) -> None:
    (tmp_path / "letter.txt").write_text("Dear reader,\nnothing to see here.\n")

    done = run("import", "letter.txt", workbook, "missing.cxf", "--to", "colours")

    assert done.returncode == 3
    assert len(list((tmp_path / "colours").iterdir())) == 2
    assert "missing.cxf: cannot be read (No such file or directory)" in done.stderr
    assert "letter.txt" in done.stderr
    assert "3 files, 2 colours, 2 with refusals" in done.stdout


def test_call_without_files_names_the_next_step(run: Run) -> None:
    done = run("import")

    assert done.returncode == 2
    assert "paintlink import --list-formats" in done.stderr


def test_unknown_format_and_zone_are_refused_with_a_hint(
    run: Run, workbook: Path
) -> None:
    wrong = run("import", workbook, "--format", "mat12_xls")
    zone = run("import", workbook, "--time-zone", "Mars/Olympus")

    assert wrong.returncode == zone.returncode == 2
    assert "did you mean 'mat12_xlsx'?" in wrong.stderr
    assert "write one such as Europe/Berlin or UTC" in zone.stderr


def test_formats_are_listed(run: Run) -> None:
    done = run("import", "--list-formats")

    assert done.returncode == 0
    assert "mat12_xlsx       X-Rite MA-T12 quality control workbook" in done.stdout


def test_profile_is_proposed_and_then_used(run: Run, tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text(wide(), encoding="utf-8")
    refused = run("import", "table.csv", "--dry-run")

    made = run("import", "table.csv", "--make-profile", "-o", "shop.toml")
    done = run("import", "table.csv", "--dry-run", "--profile", "shop.toml")

    assert refused.returncode == 3
    assert "make one with `paintlink import FILE --make-profile -o" in refused.stderr
    assert made.returncode == 0
    assert "check conditions: the headings do not say" in made.stderr
    assert done.returncode == 0
    assert done.stdout.count("can be imported") == 2


def test_profiles_beside_the_configuration_are_found(run: Run, tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text(wide(), encoding="utf-8")
    (tmp_path / "profiles").mkdir()
    (tmp_path / "paintlink.toml").write_text(f'[site]\nfolder = "{tmp_path}/site"\n')
    run("import", "table.csv", "--make-profile", "-o", "profiles/shop.toml")

    done = run("import", "table.csv", "--dry-run", "--config", "paintlink.toml")

    assert done.returncode == 0, done.stderr
    assert done.stdout.count("can be imported") == 2


def test_profile_wizard_wants_one_file(run: Run, tmp_path: Path) -> None:
    done = run("import", "a.csv", "b.csv", "--make-profile")

    assert done.returncode == 2
    assert "looks at one table: name one file" in done.stderr


def test_impossible_geometry_option_is_a_wrong_call(run: Run, workbook: Path) -> None:
    done = run("import", workbook, "--geometry", "sideways")

    assert done.returncode == 2
    assert "--geometry: geometry 'sideways' is not of the form" in done.stderr
