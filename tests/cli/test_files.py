"""Commands that read and write files."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from PIL import Image

from paintlink.spec import read_spec, read_spec_file
from tests.cli.conftest import Run
from tests.daemon.conftest import make_spec


def test_validate_names_identity_and_angles(run: Run, spec_file: Path) -> None:
    done = run("validate", spec_file)

    assert done.returncode == 0
    assert "valid, 'grey', 15/45/110 degrees" in done.stdout


def test_validate_goes_on_after_a_bad_file(run: Run, spec_file: Path) -> None:
    bad = spec_file.with_name("bad.xml")
    bad.write_text(spec_file.read_text().replace("80.1", "180.1"))

    done = run("validate", bad, spec_file)

    assert done.returncode == 3
    assert "grey.xml: valid" in done.stdout
    assert "bad.xml, line " in done.stderr
    assert "180.1" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda path: None, "cannot be read"),
        (lambda path: path.write_bytes(b""), "empty"),
        (lambda path: path.mkdir(), "not a regular file|folder|directory"),
        (os.mkfifo, "regular file"),
    ],
    ids=["missing", "empty", "folder", "fifo"],
)
def test_unusable_file_is_named_without_traceback(
    run: Run, tmp_path: Path, make: object, says: str
) -> None:
    path = tmp_path / "spec.xml"
    make(path)  # type: ignore[operator]

    done = run("snap", path)

    assert done.returncode == 3
    assert done.stderr.startswith("paintlink: ")
    assert "spec.xml" in done.stderr
    assert any(word in done.stderr for word in says.split("|")), done.stderr


def test_convert_to_canonical_form_is_stable(run: Run, spec_file: Path) -> None:
    done = run("convert", spec_file)

    assert done.returncode == 0
    assert done.stdout.encode() == spec_file.read_bytes()
    assert read_spec(done.stdout.encode()) == make_spec("grey")


def test_convert_to_json_keeps_every_number(run: Run, spec_file: Path) -> None:
    done = run("convert", spec_file, "--to", "json")

    document = json.loads(done.stdout)
    assert [80.1, 2.0, -3.5] in list(lab_triples(document))


def test_convert_refuses_to_overwrite(run: Run, spec_file: Path) -> None:
    done = run("convert", spec_file, "-o", spec_file)

    assert done.returncode == 5
    assert "exists: choose another name" in done.stderr
    assert read_spec_file(spec_file) == make_spec("grey")


def test_convert_to_unknown_format_lists_known(run: Run, spec_file: Path) -> None:
    done = run("convert", spec_file, "--to", "pdf")

    assert done.returncode == 2
    assert "no export format 'pdf'; there are colornet, csv, cxf3, json" in done.stderr


def test_export_delivers_with_a_starting_paint(
    run: Run, spec_file: Path, tmp_path: Path
) -> None:
    (tmp_path / "watched").mkdir()

    done = run("export", spec_file, "--to", "watched", "--json")

    answer = json.loads(done.stdout)
    text = (tmp_path / answer["file"]).read_text()
    assert done.returncode == 0
    assert "<startingPaint>" in text
    assert "Virtual 6000 (synthetic)" in text


def test_export_into_missing_folder_says_create_it(run: Run, spec_file: Path) -> None:
    done = run("export", spec_file, "--to", "nowhere")

    assert done.returncode == 5
    assert "nowhere" in done.stderr
    assert "create it" in done.stderr


def test_preview_writes_a_picture(run: Run, spec_file: Path, tmp_path: Path) -> None:
    done = run(
        "preview", spec_file, "-o", "out.png", "--size", "128", "--backend", "cpu"
    )

    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "out.png") as picture:
        assert picture.size[0] == 128
        assert len(picture.getcolors(1 << 16) or []) > 50


def test_preview_of_unknown_object_suggests_one(run: Run, spec_file: Path) -> None:
    done = run("preview", spec_file, "-o", "out.png", "--object", "spere")

    assert done.returncode == 5
    assert "sphere" in done.stderr


def test_unknown_command_gets_a_suggestion(run: Run) -> None:
    done = run("validat")

    assert done.returncode == 2
    assert "Did you mean `paintlink validate`?" in done.stderr


def lab_triples(document: object) -> list[list[float]]:
    """Every L, a, b in a JSON document."""
    if isinstance(document, dict):
        found = [x for value in document.values() for x in lab_triples(value)]
        if {"L", "a", "b"} <= set(document):
            found.append([document["L"], document["a"], document["b"]])
        return found
    if isinstance(document, list):
        return [x for value in document for x in lab_triples(value)]
    return []
