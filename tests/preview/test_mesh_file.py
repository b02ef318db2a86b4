from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import mesh_file, render
from tests.preview.test_mesh import ball
from tests.preview.truth import GREY, SILVER

trimesh = pytest.importorskip("trimesh")
pytestmark = pytest.mark.usefixtures("coarse_bake")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    whole = ball()
    trimesh.Trimesh(whole.vertices, whole.faces).export(tmp_path / "ball.ply")
    return tmp_path


@pytest.mark.parametrize("kind", ["obj", "glb", "ply", "stl"])
def test_every_format_gives_the_same_picture(folder: Path, kind: str) -> None:
    path = folder / f"ball.{kind}"
    trimesh.load_mesh(folder / "ball.ply").export(path)

    pictures = [
        render([SILVER], object=str(file), size=64, backend="cpu").rgb.astype(int)
        for file in (path, folder / "ball.ply")
    ]

    assert np.abs(pictures[0] - pictures[1]).mean() < 0.5


def test_broken_winding_and_holes_do_not_change_the_colours(folder: Path) -> None:
    whole = ball()
    faces = whole.faces.copy()
    faces[::2] = faces[::2, ::-1]
    broken = trimesh.Trimesh(whole.vertices, np.delete(faces, 700, 0), process=False)
    broken.export(folder / "broken.ply")

    good, bad = (
        render([GREY], object=str(folder / name), size=64, backend="cpu").rgb
        for name in ("ball.ply", "broken.ply")
    )

    difference = np.abs(good.astype(int) - bad).max(axis=2)
    assert np.median(difference) <= 1
    assert (difference > 30).mean() < 0.03


def test_changed_file_is_read_again(folder: Path) -> None:
    path = folder / "ball.ply"
    first = mesh_file.load(path)
    trimesh.creation.box().export(path)

    assert len(mesh_file.load(path).faces) < len(first.faces)


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("empty.obj", b"", "no triangles with an area"),
        ("noise.glb", b"\x00\x01noise" * 20, "is no mesh that can be read"),
        ("cut.ply", b"ply\nformat ascii 1.0\nelement vertex 9\n", "no mesh|nothing"),
    ],
)
def test_file_without_a_mesh_is_refused(
    tmp_path: Path, name: str, content: bytes, words: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)

    with pytest.raises(PreviewError, match=words):
        mesh_file.load(path)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(
        PreviewError, match=r"cannot read the object .*none.obj: No such"
    ):
        render([GREY], object=str(tmp_path / "none.obj"))


def test_huge_file_is_not_even_opened(tmp_path: Path) -> None:
    path = tmp_path / "huge.stl"
    with path.open("wb") as file:
        file.truncate(mesh_file.MOST_BYTES + 1)

    with pytest.raises(PreviewError, match="256 MiB, more than 256"):
        mesh_file.load(path)
