"""From a pose to the two angles every pixel shows."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.sketch.pose import Light, Pose
from paintlink.sketch.shapes import SHAPES, Shape, Surface
from paintlink.sketch.values import PixelGeometry

BAND_PIXELS = 1 << 16
"""Pixels worked on at a time: what numpy keeps for them stays in the cache."""


def pixel_geometry(
    pose: Pose, shift_px: tuple[float, float] = (0.0, 0.0)
) -> PixelGeometry:
    """Angles of every pixel; the same pose always gives the same bits.

    The view is orthographic from the front. With n the normal, v = (0, 0, 1) the view,
    l the direction to the light and r = 2(n·v)n − v the mirror direction, the aspecular
    angle is 2·asin(½|r − l|), exact near 0 where the arc cosine is not, and phi is n·l.
    Pixels the outline cuts do not belong to the mask.

    Parameters
    ----------
    shift_px
        How far the object lies right of and below its place, for a picture that was
        moved.
    """
    shape = SHAPES[pose.object]
    theta = np.zeros((pose.size, pose.size), dtype=np.float32)
    phi, mask = np.zeros_like(theta), np.zeros(theta.shape, dtype=np.bool_)
    for rows in bands(pose.size):
        x, y = places(pose.size, rows, shift_px)
        seen = shape.surface(x, y)
        theta[rows], phi[rows] = _angles(seen, x, y, pose.light, shape)
        mask[rows] = (shape.margin(x, y) > 1.0 / pose.size) & (phi[rows] > 0.0)
    return _sealed(theta, phi, mask)


def coverage(pose: Pose, shift_px: tuple[float, float] = (0.0, 0.0)) -> Float32Array:
    """Share of each pixel that lies within the outline, 0 to 1."""
    shape = SHAPES[pose.object]
    cover = np.empty((pose.size, pose.size), dtype=np.float32)
    for rows in bands(pose.size):
        margin = shape.margin(*places(pose.size, rows, shift_px))
        cover[rows] = np.clip(0.5 + margin * (pose.size / 2.0), 0.0, 1.0)
    return cover


def bands(size: int) -> Iterator[slice]:
    """Rows to work on at a time."""
    step = max(1, BAND_PIXELS // size)
    return (slice(top, min(top + step, size)) for top in range(0, size, step))


def places(
    size: int, rows: slice, shift_px: tuple[float, float] = (0.0, 0.0)
) -> tuple[FloatArray, FloatArray]:
    """Picture coordinates x and y of pixel centres, both shape (rows, size)."""
    right, down = shift_px
    column = np.arange(size, dtype=np.float64) + 0.5 - right
    row = np.arange(rows.start, rows.stop, dtype=np.float64) + 0.5 - down
    x, y = np.meshgrid(2.0 * column / size - 1.0, 1.0 - 2.0 * row / size)
    return x, y


def _angles(
    surface: Surface, x: FloatArray, y: FloatArray, light: Light, shape: Shape
) -> tuple[FloatArray, FloatArray]:
    """Aspecular angle and cosine to the light."""
    nx, ny, nz = surface.normal
    lx, ly, lz = _to_light(surface, x, y, light, shape)
    apart_x, apart_y = 2.0 * nz * nx - lx, 2.0 * nz * ny - ly
    apart_z = 2.0 * nz * nz - 1.0 - lz
    apart = np.sqrt(apart_x * apart_x + apart_y * apart_y + apart_z * apart_z)
    theta = np.degrees(2.0 * np.arcsin(np.minimum(0.5 * apart, 1.0)))
    return theta, nx * lx + ny * ly + nz * lz


def _to_light(
    surface: Surface, x: FloatArray, y: FloatArray, light: Light, shape: Shape
) -> tuple[FloatArray | float, FloatArray | float, FloatArray | float]:
    """Unit vectors to the light: one for all points, or one for each."""
    if light.kind == "directional":
        return light.direction
    lamp_x, lamp_y, lamp_z = (
        light.distance * shape.radius * part for part in light.direction
    )
    right, up = lamp_x - x, lamp_y + shape.centre_y - y
    towards = lamp_z - surface.z
    away = np.sqrt(right * right + up * up + towards * towards)
    return right / away, up / away, towards / away


def _sealed(theta: Float32Array, phi: Float32Array, mask: object) -> PixelGeometry:
    geometry = PixelGeometry(theta, phi, np.asarray(mask, dtype=np.bool_))
    for plane in (geometry.theta_deg, geometry.phi, geometry.mask):
        plane.setflags(write=False)
    return geometry
