"""What a camera sees of a mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.preview.camera import Camera, Eye
from paintlink.preview.mesh import Mesh
from paintlink.preview.occlusion import Occlusion
from paintlink.preview.raster import NOTHING, barycentric, rasterise
from paintlink.preview.surface import Surface, pixel_centres, samples_across


class _Samples(NamedTuple):
    """Places of triangles, several in each pixel, pixel by pixel.

    Parameters
    ----------
    pixel
        In which pixel each of m samples lies, ascending.
    face
        On which triangle.
    weights
        Of the triangle's corners, shape (m, 3).
    """

    pixel: NDArray[np.intp]
    face: NDArray[np.int32]
    weights: FloatArray


def surface(
    mesh: Mesh, shade: Occlusion, camera: Camera, *, size: int, rows: slice
) -> Surface:
    """What the camera sees of the mesh in some rows of a picture."""
    eye = Eye(mesh, camera)
    samples = _samples(eye.placed(mesh), mesh, size, rows)
    if camera.perspective:
        samples = _upright(samples, eye.placed(mesh)[:, 2][mesh.faces[samples.face]])
    pixels, first, count = np.unique(
        samples.pixel, return_index=True, return_counts=True
    )
    points = _mixed(samples, mesh.vertices[mesh.faces[samples.face]])
    towards = eye.towards(points)
    normals = _facing(eye, mesh, samples, towards)
    lit = _lit(eye, mesh, shade, samples, normals)
    return Surface(
        view=camera.view,
        pixels=pixels,
        cover=(count / samples_across(size) ** 2).astype(np.float32),
        first=first,
        normals=normals,
        towards=towards,
        lit=(_summed(lit, first) / count).astype(np.float32),
        behind=eye.behind(shade, *pixel_centres(size, rows)),
    )


def _samples(placed: FloatArray, mesh: Mesh, size: int, rows: slice) -> _Samples:
    across = samples_across(size)
    scale = size * across / 2.0
    corners = placed[mesh.faces]
    corners[:, :, 0] = (1.0 + corners[:, :, 0]) * scale
    corners[:, :, 1] = (1.0 - corners[:, :, 1]) * scale - rows.start * across
    width, height = size * across, (rows.stop - rows.start) * across
    face = rasterise(corners, width, height).face
    hit = np.flatnonzero(face != NOTHING)
    row, column = np.divmod(hit, width)
    pixel = row // across * size + column // across
    order = np.argsort(pixel, kind="stable")
    hit, row, column = hit[order], row[order], column[order]
    weights = barycentric(corners[face[hit]], column + 0.5, row + 0.5)
    return _Samples(pixel[order], face[hit], weights)


def _upright(samples: _Samples, nearness: FloatArray) -> _Samples:
    """Weights in space instead of in the picture, where near parts are larger."""
    weights = samples.weights * nearness
    return samples._replace(weights=weights / weights.sum(axis=1, keepdims=True))


def _facing(
    eye: Eye, mesh: Mesh, samples: _Samples, towards: Float32Array | None
) -> Float32Array:
    """Normals as the viewer sees them, of the side that is seen, (m, 3)."""
    normals = eye.seen(_mixed(samples, mesh.corner_normals[samples.face]))
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    flat = eye.seen(mesh.face_normals[1][samples.face])
    towards_viewer = np.array([[0.0, 0.0, 1.0]]) if towards is None else towards
    facing = (flat * towards_viewer).sum(axis=1)
    turned: Float32Array = np.where(facing[:, None] < 0.0, -normals, normals)
    return turned.astype(np.float32)


def _lit(
    eye: Eye, mesh: Mesh, shade: Occlusion, samples: _Samples, normals: Float32Array
) -> FloatArray:
    """Share of the light that arrives on the side that is seen, (m,)."""
    corners = mesh.faces[samples.face]
    sides = np.einsum("nic,nc->ni", eye.seen(mesh.vertex_normals)[corners], normals)
    return _mixed(samples, shade.vertices[corners, (sides < 0.0).astype(np.intp)])


def _mixed(samples: _Samples, corners: FloatArray | Float32Array) -> FloatArray:
    """Values between the corners' values, shape (m, ...)."""
    mixed: FloatArray = np.einsum("ni,ni...->n...", samples.weights, corners)
    return mixed


def _summed(values: FloatArray, first: NDArray[np.intp]) -> FloatArray:
    return np.add.reduceat(values, first) if len(first) else np.empty(0)
