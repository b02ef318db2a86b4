from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from paintlink.preview import disc


def smooth(normals: np.ndarray) -> np.ndarray:
    return np.stack([1 + normals[..., 0], normals[..., 1] * normals[..., 2]], axis=-1)


TABLE = smooth(disc.normals(128)).astype(np.float32)


def leaning(azimuth: float, tilt: float) -> np.ndarray:
    across = np.sin(tilt)
    place = [across * np.cos(azimuth), across * np.sin(azimuth), np.cos(tilt)]
    return np.array([place], dtype=np.float32)


@given(st.floats(0, 2 * np.pi), st.floats(0, np.radians(87)))
def test_look_up_interpolates_between_texels(azimuth: float, tilt: float) -> None:
    normal = leaning(azimuth, tilt)

    np.testing.assert_allclose(disc.look_up(TABLE, normal), smooth(normal), atol=2e-3)


@given(st.floats(0, 2 * np.pi), st.floats(np.radians(87), np.pi / 2))
def test_look_up_holds_within_half_a_texel_at_the_rim(
    azimuth: float, tilt: float
) -> None:
    normal = leaning(azimuth, tilt)

    half_texel = np.pi / 2 / 128
    found = disc.look_up(TABLE, normal)
    np.testing.assert_allclose(found, smooth(normal), atol=half_texel)


def test_normals_facing_away_take_the_rim() -> None:
    away = np.array([[0.6, 0.0, -0.8], [0.0, -0.1, -0.99]], dtype=np.float32)
    rim = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]], dtype=np.float32)

    np.testing.assert_allclose(
        disc.look_up(TABLE, away), disc.look_up(TABLE, rim), atol=1e-5
    )


def test_top_row_of_the_table_looks_up() -> None:
    normals = disc.normals(64)

    assert normals[0, 32, 1] > 0.99
    assert normals[32, 63, 0] > 0.99
    np.testing.assert_allclose(np.linalg.norm(normals, axis=2), 1, atol=1e-6)


def test_only_needed_texels_are_ever_read() -> None:
    holes = np.where(disc.needed(128)[..., None], TABLE, np.nan).astype(np.float32)
    azimuth = np.linspace(0, 2 * np.pi, 2000)
    rim = np.stack([np.cos(azimuth), np.sin(azimuth), 0 * azimuth], axis=1)

    found = disc.look_up(holes, rim.astype(np.float32))

    assert np.isfinite(found).all()


def test_view_is_mirrored_about_the_normal() -> None:
    normals = np.array([[0, 0, 1], [np.sqrt(0.5), 0, np.sqrt(0.5)]], dtype=np.float32)

    mirrored = disc.mirror_directions(normals)

    np.testing.assert_allclose(mirrored, [[0, 0, 1], [1, 0, 0]], atol=1e-6)
