from __future__ import annotations

import numpy as np
import pytest

from paintlink.preview import raster
from paintlink.preview.raster import NOTHING, barycentric, rasterise

LEFT = [[0, 0, 1], [8, 0, 1], [0, 8, 1]]
NEARER = [[0, 0, 2], [4, 0, 2], [0, 4, 2]]


def faces(*corners: list[list[float]]) -> np.ndarray:
    return rasterise(np.array(corners, float), 8, 8).face.reshape(8, 8)


def test_triangle_covers_the_centres_inside_it() -> None:
    face = faces(LEFT)

    assert (face == 0).sum() == 36
    assert face[7, 7] == NOTHING


def test_both_sides_are_drawn() -> None:
    assert (faces(LEFT[::-1]) == faces(LEFT)).all()


@pytest.mark.parametrize("order", [(LEFT, NEARER), (NEARER, LEFT)])
def test_nearest_triangle_wins_in_any_order(order: tuple[list, list]) -> None:
    face = faces(*order)

    assert order[face[0, 0]] is NEARER
    assert order[face[0, 6]] is LEFT


def test_portions_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(0)
    corners = random.uniform(-4, 36, (200, 3, 3))
    whole = rasterise(corners, 32, 32)
    monkeypatch.setattr(raster, "FRAGMENTS_AT_ONCE", 300)

    parts = rasterise(corners, 32, 32)

    np.testing.assert_array_equal(whole.face, parts.face)
    np.testing.assert_array_equal(whole.nearness, parts.nearness)


def test_what_lies_outside_is_no_trouble() -> None:
    assert (faces([[20, 20, 1], [30, 20, 1], [20, 30, 1]]) == NOTHING).all()
    assert (faces([[-90, -90, 1], [200, -90, 1], [-90, 200, 1]]) == 0).all()


def test_weights_give_back_the_place() -> None:
    corners = np.array([LEFT], float)

    weights = barycentric(corners, np.array([2.0]), np.array([3.0]))

    np.testing.assert_allclose(weights @ corners[0, :, :2], [[2, 3]])
