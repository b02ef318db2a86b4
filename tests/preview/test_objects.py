from __future__ import annotations

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.preview import object_names
from paintlink.preview.forms import load_shape
from paintlink.preview.relief import Shape

SIDE = 200
PLACES = (2 * np.arange(SIDE) + 1) / SIDE - 1
X, Y = np.meshgrid(PLACES, -PLACES)


RELIEFS = [name for name in object_names() if hasattr(load_shape(name), "margin")]


@pytest.fixture(params=RELIEFS)
def shape(request: pytest.FixtureRequest) -> Shape:
    return load_shape(request.param)


def test_folder_is_the_list_of_objects() -> None:
    assert object_names() == ("bonnet", "car", "cylinder", "panel", "sphere")


def test_object_fills_its_span_and_no_more(shape: Shape) -> None:
    inside = shape.margin(X, Y) > 0
    columns = PLACES[inside.any(axis=0)]

    assert columns[0] == pytest.approx(shape.SPAN[0], abs=0.03)
    assert columns[-1] == pytest.approx(shape.SPAN[1], abs=0.03)
    assert inside.mean() > 0.25


def test_object_keeps_off_the_edge_of_the_picture(shape: Shape) -> None:
    border = np.ones_like(X, dtype=bool)
    border[4:-4, 4:-4] = False

    assert shape.margin(X, Y)[border].max() < -0.02


def test_margin_is_a_distance_near_the_outline(shape: Shape) -> None:
    margin = shape.margin(X, Y)
    row, column = np.gradient(margin, PLACES, PLACES)

    slope = np.hypot(row, column)[np.abs(margin) < 0.02]
    assert np.median(slope) == pytest.approx(1.0, abs=0.05)
    assert np.percentile(slope, [5, 95]) == pytest.approx([1.0, 1.0], abs=0.35)


def test_normals_are_unit_and_face_the_viewer(shape: Shape) -> None:
    near = shape.margin(X, Y) > -0.005

    normals = shape.normals(X[near], Y[near])

    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    assert normals[:, 2].min() > -1e-6


def test_object_shows_face_and_flop(shape: Shape) -> None:
    inside = shape.margin(X, Y) > 0

    normals = shape.normals(X[inside], Y[inside])

    assert normals[:, 1].max() > 0.7
    assert normals[:, 1].min() < -0.5


def test_object_rests_on_its_shadows(shape: Shape) -> None:
    inside = shape.margin(X, Y) > 0

    for x, y, half_width, _ in shape.SHADOWS:
        above = inside & (np.abs(X - x) < half_width / 2)
        assert Y[above].min() == pytest.approx(y, abs=0.08)


def test_unknown_object_names_the_nearest() -> None:
    with pytest.raises(PreviewError, match="object 'spere': did you mean 'sphere'"):
        load_shape("spere")


def test_unlike_name_lists_the_objects() -> None:
    with pytest.raises(PreviewError, match="'xyzzy': There are bonnet, car, cylinder"):
        load_shape("xyzzy")
