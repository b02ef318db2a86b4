"""Commands that draw, in this process so that coarse light serves all of them."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from PIL import Image

from paintlink.cli import main, preview
from paintlink.spec import write_spec
from tests.preview.truth import GREY

pytestmark = pytest.mark.usefixtures("coarse_bake")

Run = Callable[..., Result]


@pytest.fixture
def spec_file(tmp_path: Path) -> Path:
    path = tmp_path / "grey.xml"
    path.write_bytes(write_spec(GREY))
    return path


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.setattr(preview, "cache_folder", lambda: None)
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(main, [str(word) for word in words])


def test_comparison_says_roles_and_writes_facts(
    run: Run, spec_file: Path, tmp_path: Path
) -> None:
    done = run(
        "preview", spec_file, spec_file, "-o", "two.png", "--size", "128",
        "--backend", "cpu", "--object", "sphere", "--pattern", "checker",
        "--label", "target", "--label", "candidate", "--json",
    )  # fmt: skip

    assert done.exit_code == 0, done.stderr
    names = [paint["name"] for paint in json.loads(done.stdout)["paints"]]
    assert names == ["target: test", "candidate: test"]
    assert (tmp_path / "two.png").exists()


def test_difference_of_a_paint_to_itself(run: Run, spec_file: Path) -> None:
    done = run(
        "preview", spec_file, spec_file, "-o", "map.png", "--size", "64",
        "--object", "sphere", "--difference", "--json",
    )  # fmt: skip

    assert done.exit_code == 0, done.stderr
    notes = json.loads(done.stdout)["notes"]
    assert "largest difference 0.0 dE00 on the object" in notes


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["--difference"], 2, "--difference compares two paints, not 1"),
        (["--label", "a", "--label", "b"], 2, "2 labels for 1 paints"),
        (["--turn", "20"], 5, "has no back and cannot be turned"),
        (["--sparkle", "3"], 5, "sparkle runs from 0 (none) to 1, not 3"),
        (["--light", "none.hdr"], 5, "cannot read the light none.hdr"),
        (["--object", "none.obj"], 5, "cannot read the object none.obj"),
        (["--size", "9999999"], 5, "16 to 4096 pixels wide"),
    ],
)
def test_what_cannot_be_drawn_is_named(
    run: Run, spec_file: Path, arguments: list[str], code: int, words: str
) -> None:
    done = run("preview", spec_file, "-o", "out.png", "--backend", "cpu", *arguments)

    assert done.exit_code == code
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_thumbnails_of_a_library_are_counted(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from paintlink.cli.library_state import Where
    from tests.preview.test_thumbnails import few

    monkeypatch.setattr(Where, "table", lambda self, shelf: few(5))

    first = run("library", "thumbnails", "all", "--size", "24", "--json")
    again = run("library", "thumbnails", "all", "--size", "24")

    assert json.loads(first.stdout) == {"folder": "all", "drawn": 5, "kept": 0}
    assert "all: 0 drawn, 5 there already" in again.stdout


def test_turntable_writes_an_animation(
    run: Run, spec_file: Path, tmp_path: Path
) -> None:
    done = run(
        "turntable", spec_file, "-o", "turn.webp", "--size", "32", "--frames", "3"
    )

    assert done.exit_code == 0, done.stderr
    with Image.open(tmp_path / "turn.webp") as image:
        assert image.n_frames == 3


def test_folder_of_files_gets_pictures(
    run: Run, spec_file: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "drop"
    folder.mkdir()
    (folder / "grey.xml").write_bytes(spec_file.read_bytes())
    (folder / "notes.xml").write_text("hello")
    for path in folder.iterdir():
        os.utime(path, (1_000_000, 1_000_000))

    done = run("previews", folder, "--once", "--object", "sphere", "--size", "128")

    assert done.exit_code == 0, done.stderr
    assert "grey.xml: grey.xml.png" in done.stdout
    assert json.loads((folder / "grey.xml.json").read_text())["error"] == ""
    assert json.loads((folder / "notes.xml.json").read_text())["error"]
