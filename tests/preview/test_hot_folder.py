from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path

import pytest
from PIL import Image

from paintlink.errors import InputError
from paintlink.model import ColorSpec
from paintlink.preview import Picture, render
from paintlink.preview.hot_folder import HotFolder
from tests.preview.truth import RED, SILVER

pytestmark = pytest.mark.usefixtures("coarse_bake")


def read(path: Path) -> Sequence[ColorSpec]:
    words = path.read_text().split()
    if not words:
        msg = f"{path.name}: empty"
        raise InputError(msg)
    return [{"red": RED, "silver": SILVER}[word] for word in words]


def draw(spec: ColorSpec) -> Picture:
    return render([spec], object="sphere", size=32, backend="cpu")


@pytest.fixture
def hot(tmp_path: Path) -> HotFolder:
    return HotFolder(tmp_path, read, draw)


def drop(path: Path, text: str) -> Path:
    path.write_text(text)
    os.utime(path, (1_000_000, 1_000_000))
    return path


def test_file_gets_a_picture_and_its_facts(hot: HotFolder, tmp_path: Path) -> None:
    drop(tmp_path / "paint.txt", "red")

    drawn = hot.step()

    assert drawn is not None
    assert drawn.pictures == ("paint.txt.png",)
    with Image.open(tmp_path / "paint.txt.png") as image:
        assert image.size == (32, 32)
    document = json.loads((tmp_path / "paint.txt.json").read_text())
    assert document["pictures"][0]["paints"][0]["name"] == RED.name
    assert document["error"] == ""


def test_files_that_are_gone_are_forgotten(hot: HotFolder, tmp_path: Path) -> None:
    path = drop(tmp_path / "paint.txt", "red")
    for _ in range(2):
        hot.step()
    assert list(hot._settled) == [path]

    path.unlink()
    hot.step()

    assert not hot._settled


def test_nothing_is_drawn_twice_until_it_changes(
    hot: HotFolder, tmp_path: Path
) -> None:
    path = drop(tmp_path / "paint.txt", "red")
    hot.step()

    assert hot.step() is None
    drop(path, "silver")
    assert hot.step() is not None
    assert hot.step() is None


def test_picture_is_drawn_again_when_its_words_are_removed(
    hot: HotFolder, tmp_path: Path
) -> None:
    drop(tmp_path / "paint.txt", "red")
    hot.step()
    assert hot.step() is None

    (tmp_path / "paint.txt.json").unlink()

    assert hot.step() is not None


def test_file_that_did_not_change_is_not_read_again(
    hot: HotFolder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drop(tmp_path / "paint.txt", "red")
    hot.step()
    hot.step()

    with monkeypatch.context() as patch:
        patch.setattr(Path, "open", None)
        assert hot.step() is None


def test_several_colours_get_several_pictures(hot: HotFolder, tmp_path: Path) -> None:
    drop(tmp_path / "both.txt", "red silver")

    drawn = hot.step()

    assert drawn is not None
    assert drawn.pictures == ("both.txt.1.png", "both.txt.2.png")


def test_file_that_cannot_be_read_is_told_once(hot: HotFolder, tmp_path: Path) -> None:
    drop(tmp_path / "empty.txt", "")
    drop(tmp_path / "red.txt", "red")

    first, second = hot.step(), hot.step()

    assert first is not None
    assert "empty.txt: empty" in first.error
    assert json.loads((tmp_path / "empty.txt.json").read_text())["error"]
    assert second is not None
    assert second.pictures == ("red.txt.png",)
    assert hot.step() is None


def test_file_still_being_written_is_left_alone(tmp_path: Path) -> None:
    path = drop(tmp_path / "paint.txt", "red")
    clock = [path.stat().st_mtime + 0.1]
    hot = HotFolder(tmp_path, read, draw, now=lambda: clock[0])

    assert hot.step() is None
    clock[0] += 1.0
    assert hot.step() is not None


def test_only_real_files_of_others_are_drawn(hot: HotFolder, tmp_path: Path) -> None:
    drop(tmp_path / ".hidden", "red")
    drop(tmp_path / "old.png", "red")
    (tmp_path / "link.txt").symlink_to(tmp_path / ".hidden")
    (tmp_path / "folder").mkdir()

    assert hot.step() is None
