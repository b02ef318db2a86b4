from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview.mesh import MOST_TRIANGLES, Mesh, checked

CUBE = np.array([[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)], float)
CUBE_FACES = np.array([
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
    [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
])  # fmt: skip


def ball(rings: int = 24) -> Mesh:
    polar = np.linspace(0, np.pi, rings + 1)
    turn = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    p, t = np.meshgrid(polar, turn, indexing="ij")
    points = np.stack([np.sin(p) * np.sin(t), np.cos(p), np.sin(p) * np.cos(t)], -1)
    row, column = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    a = (row * 2 * rings + column).ravel()
    b = (row * 2 * rings + (column + 1) % (2 * rings)).ravel()
    faces = np.concatenate([
        np.stack([a, a + 2 * rings, b], 1),
        np.stack([b, a + 2 * rings, b + 2 * rings], 1),
    ])
    return checked(points.reshape(-1, 3), faces, "ball")


def test_edges_of_a_cube_stay_sharp() -> None:
    normals = checked(CUBE, CUBE_FACES, "cube").corner_normals

    np.testing.assert_allclose(np.abs(normals).max(axis=2), 1, atol=1e-6)


def test_a_fine_ball_is_smooth() -> None:
    mesh = ball()
    facing = np.linalg.norm(mesh.vertices, axis=1, keepdims=True)

    agreement = np.einsum(
        "tic,tic->ti", mesh.corner_normals, (mesh.vertices / facing)[mesh.faces]
    )
    assert agreement.min() > 0.98


def test_mesh_is_brought_to_the_middle_and_to_size_one() -> None:
    mesh = checked(CUBE * 30 + 500, CUBE_FACES, "cube")

    np.testing.assert_allclose(mesh.vertices.min(0), -mesh.vertices.max(0), atol=1e-9)
    assert np.hypot(*mesh.vertices[:, [0, 2]].T).max() == pytest.approx(1)


def test_a_point_where_very_many_triangles_meet_takes_no_long_time() -> None:
    rim = np.linspace(0, 2 * np.pi, 20_000, endpoint=False)
    points = np.stack([np.cos(rim), np.sin(rim), 0 * rim], axis=1)
    number = np.arange(1, len(rim))
    faces = np.stack([0 * number, number, number + 1], axis=1)
    fan = checked(np.concatenate([[[0, 0, 1]], points]), faces, "fan")

    assert np.linalg.norm(fan.corner_normals, axis=2).min() > 0.99


@pytest.mark.parametrize(
    ("vertices", "faces", "words"),
    [
        (CUBE, np.empty((0, 3), int), "no triangles with an area"),
        (CUBE * 0, CUBE_FACES, "no triangles with an area"),
        (CUBE * np.nan, CUBE_FACES, "vertices that are not numbers"),
        (CUBE, np.zeros((MOST_TRIANGLES + 1, 3), int), "reduce it in the program"),
    ],
)
def test_mesh_with_nothing_to_draw_or_too_much_is_refused(
    vertices: np.ndarray, faces: np.ndarray, words: str
) -> None:
    with pytest.raises(PreviewError, match=words):
        checked(vertices, faces, "thing.obj")
