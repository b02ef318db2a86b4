from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import InputError
from paintlink.sketch.geometry import coverage, pixel_geometry, places
from paintlink.sketch.pose import Light, Pose, light_for
from paintlink.sketch.shapes import SHAPES
from paintlink.sketch.support import survey, unsupported
from tests.sketch.easel import OBJECTS

ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)


def from_slopes(name: str, x: float, y: float) -> np.ndarray:
    """The normal of an object from its height alone."""
    step = 1e-5
    place = [np.array([x - step, x + step, x, x]), np.array([y, y, y - step, y + step])]
    z = SHAPES[name].surface(*place).z
    normal = np.array([(z[0] - z[1]) / (2 * step), (z[2] - z[3]) / (2 * step), 1.0])
    return normal / np.linalg.norm(normal)


@pytest.mark.parametrize("name", OBJECTS)
@settings(deadline=None)
@given(x=st.floats(-0.5, 0.5), y=st.floats(-0.4, 0.5))
def test_normals_agree_with_the_heights(name: str, x: float, y: float) -> None:
    surface = SHAPES[name].surface(np.array([x]), np.array([y]))

    np.testing.assert_allclose(
        np.ravel(surface.normal), from_slopes(name, x, y), atol=1e-6
    )


@pytest.mark.parametrize("name", OBJECTS)
@pytest.mark.parametrize("distance", [None, 2.5])
def test_angles_follow_the_formulas(name: str, distance: float | None) -> None:
    pose = Pose(name, light_for(name, (40.0, 120.0), distance), 256)
    geometry = pixel_geometry(pose)
    row, column = 100, 154
    x, y = 2 * (column + 0.5) / 256 - 1, 1 - 2 * (row + 0.5) / 256
    normal = from_slopes(name, x, y)

    light = np.array(pose.light.direction)
    if distance:
        shape = SHAPES[name]
        z = shape.surface(np.array([x]), np.array([y])).z[0]
        lamp = light * distance * shape.radius + [0.0, shape.centre_y, 0.0]
        light = (lamp - [x, y, z]) / np.linalg.norm(lamp - [x, y, z])
    mirror = 2 * normal[2] * normal - [0, 0, 1]
    theta = np.degrees(
        np.arctan2(np.linalg.norm(np.cross(mirror, light)), mirror @ light)
    )
    assert geometry.theta_deg[row, column] == pytest.approx(theta, abs=1e-4)
    assert geometry.phi[row, column] == pytest.approx(normal @ light, abs=1e-6)


def test_same_pose_gives_the_same_bits() -> None:
    pose = Pose("panel", light_for("panel", None, 4.0), 256)

    first, second = pixel_geometry(pose), pixel_geometry(pose)

    assert first.theta_deg.tobytes() == second.theta_deg.tobytes()
    assert first.phi.tobytes() == second.phi.tobytes()
    assert first.mask.tobytes() == second.mask.tobytes()


def test_mirror_direction_is_found_exactly() -> None:
    geometry = pixel_geometry(Pose("sphere", Light(30.0, 135.0), 2048))

    assert geometry.theta_deg[geometry.mask].min() < 0.1


@pytest.mark.parametrize("name", OBJECTS)
def test_mask_shows_lit_paint_only(name: str) -> None:
    pose = Pose(name, Light(60.0, 135.0), 256)
    geometry = pixel_geometry(pose)

    assert (geometry.phi[geometry.mask] > 0.0).all()
    assert (coverage(pose)[geometry.mask] == 1.0).all()
    shadow = (coverage(pose) == 1.0) & ~geometry.mask
    assert (geometry.phi[shadow] <= 0.01).all()


def test_moved_geometry_is_the_same_elsewhere() -> None:
    pose = Pose("panel", light_for("panel"), 256)

    moved = pixel_geometry(pose, (7.0, -3.0)).theta_deg

    still = pixel_geometry(pose).theta_deg
    np.testing.assert_allclose(moved[20:-20, 27:-20], still[23:-17, 20:-27], atol=1e-4)


def test_rows_run_down_and_columns_right() -> None:
    x, y = places(128, slice(0, 2))

    assert x[0, 0] == pytest.approx(-1 + 1 / 128)
    assert y[0, 0] == pytest.approx(1 - 1 / 128)
    assert y[1, 0] < y[0, 0]


@pytest.mark.parametrize("name", OBJECTS)
def test_usual_lights_show_every_angle(name: str) -> None:
    assert unsupported(survey(Pose(name, light_for(name), 256)), ANGLES) == ()


def test_panel_lit_from_the_viewer_lacks_the_flop() -> None:
    pose = Pose("panel", Light(0.0, 0.0), 1024)

    assert unsupported(survey(pose), ANGLES) == (110.0,)


@pytest.mark.parametrize(
    ("polar", "azimuth", "distance", "words"),
    [
        (-1.0, 0.0, 4.0, "0 to 85 degrees off the view, not -1"),
        (float("nan"), 0.0, 4.0, "not nan"),
        (30.0, float("inf"), 4.0, "azimuth of the light is an angle, not inf"),
        (30.0, 0.0, 1.5, "at least 2 half widths .* not 1.5"),
        (30.0, 0.0, float("nan"), "not nan"),
    ],
)
def test_impossible_lights_are_refused(
    polar: float, azimuth: float, distance: float, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        Light(polar, azimuth, "point", distance)


def test_unknown_object_and_size_are_refused() -> None:
    with pytest.raises(InputError, match="no sketch object 'car'; there are cylinder"):
        light_for("car")
    with pytest.raises(InputError, match="256 to 4096 pixels wide, not 100"):
        Pose("sphere", Light(30.0, 0.0), 100)
