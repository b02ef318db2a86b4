from __future__ import annotations

import numpy as np

from paintlink.preview.mesh import Mesh, checked
from paintlink.preview.occlusion import occlusion
from tests.preview.test_mesh import ball


def test_a_ball_in_the_open_is_lit_above_and_shaded_where_it_stands() -> None:
    mesh = ball()

    shade = occlusion(mesh)

    front, height = shade.vertices[:, 0], mesh.vertices[:, 1]
    assert front[height > 0.5].min() > 0.9
    assert front[height < -0.95].max() < 0.7


def test_floor_is_dark_below_the_ball_and_clear_far_off() -> None:
    floor = occlusion(ball()).floor

    assert floor[31, 31] < 0.4
    assert floor[31, 31] < floor[31, 42] < floor[31, 52]
    np.testing.assert_allclose(floor[0], 1, atol=0.02)


def test_inside_of_a_bowl_is_darker_than_its_outside() -> None:
    whole = ball()
    kept = (whole.vertices[whole.faces][:, :, 1] < 0.01).all(axis=1)
    bowl = checked(whole.vertices, whole.faces[kept], "bowl")

    shade = occlusion(Mesh(bowl.vertices, bowl.faces[:, ::-1]))

    side = np.abs(bowl.vertices[:, 1]) < 0.2
    inside, outside = shade.vertices[side].mean(axis=0)
    assert inside < outside - 0.1
