from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from paintlink.spec import read_spec_file
from tests.cli.conftest import Run


@pytest.fixture
def folder(run: Run, spec_file: Path, tmp_path: Path) -> Path:
    """A set-up on a sphere, with the object painted redder."""
    place = tmp_path / "sketch"
    done = run("sketch", "setup", spec_file, "--size", "512", "--to", place)
    assert done.returncode == 0, done.stderr
    _paint(place)
    return place


def _paint(place: Path) -> None:
    with Image.open(place / "start.png") as start:
        codes = np.asarray(start.convert("RGB")).copy()
    with Image.open(place / "geometry.png") as geometry:
        on_object = np.asarray(geometry)[..., 2] > 0
    linear = (codes[on_object] / 255.0) ** 2.2 * [0.9, 0.3, 0.25]
    codes[on_object] = np.rint(255.0 * linear ** (1 / 2.2))
    Image.fromarray(codes).save(place / "painted.png")


def test_a_painting_becomes_a_specification(run: Run, folder: Path) -> None:
    done = run("sketch", "fit", folder / "painted.png", "-o", "red.xml")

    assert done.returncode == 0, done.stderr
    assert "measured" in done.stdout
    spec = read_spec_file(folder.parent / "red.xml")
    assert spec.name == "painted"
    assert spec.angles_deg == (15.0, 25.0, 45.0, 75.0, 110.0)
    assert (spec.lab()[:, 1] > 5.0).all()


def test_fit_answers_in_json(run: Run, folder: Path) -> None:
    done = run(
        "sketch", "fit", folder / "painted.png", "--recipe", folder / "recipe.json",
        "-o", "red.xml", "--angles", "3", "--report", "red.png", "--json",
        "--name", "Rot",
    )  # fmt: skip

    document = json.loads(done.stdout)
    assert [one["state"] for one in document["angles"]] == ["measured"] * 3
    assert document["specification"]["name"] == "Rot"
    assert document["pixels"]["kept"] > 1000
    with Image.open(folder.parent / "red.png") as report:
        assert report.width > 500


def test_pictures_without_changes_are_refused(run: Run, folder: Path) -> None:
    done = run("sketch", "fit", folder / "start.png", "-o", "same.xml")

    assert done.returncode == 3
    assert not (folder.parent / "same.xml").exists()


def test_altered_geometry_is_mentioned(run: Run, folder: Path) -> None:
    Image.new("RGB", (512, 512)).save(folder / "geometry.png")

    done = run("sketch", "fit", folder / "painted.png", "-o", "red.xml")

    assert done.returncode == 0
    assert "was changed since the set-up; the recipe is used" in done.stderr


def test_specifications_are_not_replaced(run: Run, folder: Path) -> None:
    (folder.parent / "red.xml").write_text("mine")

    done = run("sketch", "fit", folder / "painted.png", "-o", "red.xml")

    assert done.returncode == 5
    assert "red.xml exists" in done.stderr
    assert (folder.parent / "red.xml").read_text() == "mine"


def test_set_up_takes_light_depth_and_object(
    run: Run, spec_file: Path, tmp_path: Path
) -> None:
    done = run(
        "sketch", "setup", spec_file, "--object", "panel", "--light", "75", "135",
        "--near", "6", "--bits", "16", "--size", "256", "--to", "deep",
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
    assert "warning: panel in this light shows too little of" in done.stderr
    recipe = json.loads((tmp_path / "deep" / "recipe.json").read_text())
    assert recipe["light"]["kind"] == "point"
    assert (recipe["light"]["distance"], recipe["bits"]) == (6.0, 16)
    assert (tmp_path / "deep" / "start.png").read_bytes()[24] == 16


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--object", "car"), "no sketch object 'car'"),
        (("--size", "100"), "256 to 4096 pixels wide"),
        (("--light", "90", "0"), "0 to 85 degrees off the view"),
    ],
)
def test_impossible_set_ups_are_refused(
    run: Run, spec_file: Path, tmp_path: Path, options: tuple[str, ...], words: str
) -> None:
    done = run("sketch", "setup", spec_file, "--to", "x", *options)

    assert done.returncode == 3
    assert words in done.stderr
    assert not (tmp_path / "x").exists()
