from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from paintlink.errors import ExportError, InputError
from paintlink.sketch.pose import Light, Pose
from paintlink.sketch.recipe_file import read_recipe, read_recipe_file
from paintlink.sketch.setup import save, set_up
from paintlink.spec import spec_id
from tests.preview.truth import SILVER, paint
from tests.sketch.easel import OBJECTS, image_of, made

FILES = {"start.png", "geometry.png", "recipe.json"}


@pytest.mark.parametrize("name", OBJECTS)
def test_digests_are_those_of_the_samples(name: str) -> None:
    setup = made(name)

    for file, digest in (
        ("start.png", setup.recipe.start_sha256),
        ("geometry.png", setup.recipe.geometry_sha256),
    ):
        samples = np.asarray(image_of(setup.files[file])).tobytes()
        assert hashlib.sha256(samples).hexdigest() == digest


def test_pictures_carry_the_recipe() -> None:
    setup = made()

    for file in ("start.png", "geometry.png"):
        text = image_of(setup.files[file]).info["paintlink"]
        assert read_recipe(text.encode()) == setup.recipe


def test_only_the_start_picture_is_in_colour() -> None:
    setup = made()

    assert image_of(setup.files["start.png"]).info["srgb"] == 0
    assert not {"srgb", "gamma", "icc_profile"} & set(
        image_of(setup.files["geometry.png"]).info
    )


def test_recipe_names_the_starting_paint() -> None:
    assert made().recipe.start_id == spec_id(SILVER)
    assert made().recipe.start.samples == SILVER.samples


def test_folder_appears_complete(tmp_path: Path) -> None:
    save(made(), tmp_path / "new" / "sketch")

    assert {path.name for path in (tmp_path / "new" / "sketch").iterdir()} == FILES
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["sketch"]
    assert read_recipe_file(tmp_path / "new/sketch/recipe.json") == made().recipe
    with Image.open(tmp_path / "new/sketch/start.png") as image:
        assert image.size == (512, 512)


def test_empty_folders_are_used(tmp_path: Path) -> None:
    save(made(), tmp_path)

    assert {path.name for path in tmp_path.iterdir()} == FILES


def test_sketches_are_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "painted.png").write_bytes(b"hours of work")

    with pytest.raises(ExportError, match="mine exists: choose a new folder"):
        save(made(), tmp_path / "mine")

    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
    assert (tmp_path / "mine" / "painted.png").read_bytes() == b"hours of work"


def test_failed_set_ups_leave_nothing(tmp_path: Path) -> None:
    broken = replace(made(), files={"start.png": b"", "no/such/name": b""})

    with pytest.raises(ExportError, match=r"sketch: No such file.*you may write to"):
        save(broken, tmp_path / "sketch")

    assert list(tmp_path.iterdir()) == []


def test_folders_below_a_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")

    with pytest.raises(ExportError, match="Not a directory; choose a folder"):
        save(made(), tmp_path / "file" / "sketch")


def test_poses_without_an_angle_are_warned_of() -> None:
    lit_from_the_viewer = Pose("panel", Light(0.0, 0.0), 256)

    warnings = set_up(SILVER, lit_from_the_viewer).warnings

    assert len(warnings) == 1
    assert "shows too little of 110 degrees" in warnings[0]
    assert made("panel").warnings == ()


def test_paints_beyond_srgb_are_warned_of() -> None:
    cyan = paint((60, -70, -10), (60, -70, -10), (30, 0, -5))

    warnings = set_up(cyan, made(size=256).recipe.pose).warnings

    assert "beyond sRGB at 15, 25, 45, 75 degrees" in warnings[0]


def test_other_depths_are_refused() -> None:
    with pytest.raises(InputError, match="8 or 16 bits a channel, not 12"):
        set_up(SILVER, made(size=256).recipe.pose, bits=12)
