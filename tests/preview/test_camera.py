from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from paintlink.errors import PreviewError
from paintlink.model import ColorSpec
from paintlink.preview import basis, environment, gather, render, store
from paintlink.preview.camera import Camera, Eye
from paintlink.preview.mesh import checked
from paintlink.preview.surface import Surface
from paintlink.preview.view import View
from tests.preview import truth
from tests.preview.test_mesh import CUBE, CUBE_FACES
from tests.preview.truth import GREY, PEARL, SILVER

VIEW = View(pitch_deg=10.0)


def seen_from(towards: np.ndarray, normals: np.ndarray) -> Surface:
    count = len(normals)
    return Surface(
        view=VIEW,
        pixels=np.arange(count),
        cover=np.ones(count, np.float32),
        first=np.arange(count),
        normals=normals.astype(np.float32),
        towards=towards.astype(np.float32),
        lit=np.ones(count, np.float32),
        behind=np.zeros((1, count)),
    )


def perspective_truth(
    spec: ColorSpec, normals: np.ndarray, towards: np.ndarray
) -> np.ndarray:
    """Quadrature with a view direction of its own for each normal, (n, 3)."""
    light = environment.load("studio").radiance
    directions, solid_angle = truth.grid()
    flux = light(directions.astype(np.float32)) * solid_angle[:, None]
    flux /= truth.normalisation(light)
    factors = truth.rgb_from_lab(truth.sheet_curve(spec))
    world, eyes = (v @ VIEW.axes.astype(float) for v in (normals, towards))
    mirror = 2 * np.einsum("nc,nc->n", world, eyes)[:, None] * world - eyes
    seen = []
    for normal, axis in zip(world, mirror, strict=True):
        theta = np.degrees(np.arccos(np.clip(directions @ axis, -1, 1)))
        factor = factors[np.rint(theta / truth.STEP_DEG).astype(int)] / np.pi
        arriving = np.maximum(directions @ normal, 0)[:, None] * flux
        seen.append((arriving * factor).sum(axis=0))
    return np.array(seen)


def test_perspective_agrees_with_quadrature() -> None:
    random = np.random.default_rng(4)
    towards = random.uniform(-0.2, 0.2, (60, 3))
    towards[:, 2] = 1
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    normals = truth.visible_normals(60, seed=4)
    facing = np.einsum("nc,nc->n", normals, towards) > 0.05
    normals, towards = normals[facing], towards[facing]
    light = environment.load("studio")

    drawn = gather.gather(
        seen_from(towards, normals), partial(store.base_table, light, None, coarse=True)
    )

    spec = SILVER
    seen = drawn.T @ basis.coefficients([spec])[0]
    error = truth.difference(seen, perspective_truth(spec, normals, towards))
    steep = np.einsum("nc,nc->n", normals, towards) > 0.3
    assert error.mean() < 0.2
    assert error[steep].mean() < 0.04
    assert error[steep].max() < 0.3


@pytest.mark.usefixtures("coarse_bake")
class TestPictures:
    def test_turning_the_car_changes_what_is_seen_not_the_exposure(self) -> None:
        front, back = (
            render([GREY], object="car", size=96, backend="cpu", turn_deg=turn).rgb
            for turn in (0, 180)
        )

        assert np.abs(front.astype(int) - back).max() > 40
        assert abs(front.mean() - back.mean()) < 3

    def test_whole_turn_ends_where_it_began(self) -> None:
        once, again = (
            render([PEARL], object="car", size=64, backend="cpu", turn_deg=turn).rgb
            for turn in (20, 380)
        )

        assert np.abs(once.astype(int) - again).max() <= 1

    def test_near_things_are_larger_in_perspective(self) -> None:
        box = checked(CUBE, CUBE_FACES, "cube")
        near = box.vertices[:, 2] > 0

        flat, close = (
            np.ptp(Eye(box, Camera(perspective=perspective)).placed(box)[near, 0])
            for perspective in (False, True)
        )

        assert close > 1.1 * flat

    def test_relief_cannot_be_turned(self) -> None:
        with pytest.raises(PreviewError, match="the panel has no back and cannot be t"):
            render([GREY], object="panel", turn_deg=30)

    def test_picture_of_a_mesh_is_the_same_in_one_band_or_many(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        from paintlink.preview import scene

        whole = render([SILVER], object="car", size=72, backend="cpu").rgb
        monkeypatch.setattr(scene, "BAND_PIXELS", 72 * 7)

        parts = render([SILVER], object="car", size=72, backend="cpu").rgb
        np.testing.assert_array_equal(whole, parts)
