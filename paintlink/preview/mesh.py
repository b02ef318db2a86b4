"""Triangles: normals with creases, and the size of a picture."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from paintlink.errors import PreviewError
from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array

CREASE_DEG = 35.0
MOST_TRIANGLES = 400_000
MOST_AROUND = 64


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles, y up, looked at along z.

    Parameters
    ----------
    vertices
        Shape (v, 3), any unit.
    faces
        Vertices of each triangle, shape (t, 3).
    """

    vertices: FloatArray
    faces: NDArray[np.intp]

    @cached_property
    def digest(self) -> str:
        """Hash of the geometry."""
        geometry = self.vertices.tobytes() + self.faces.tobytes()
        return hashlib.sha256(geometry).hexdigest()

    @cached_property
    def corner_normals(self) -> Float32Array:
        """Unit normals of the corners of each triangle, shape (t, 3, 3).

        Smooth over edges flatter than 35 degrees, whichever way round a neighbour is;
        flat where very many triangles meet.
        """
        crossed, unit = self.face_normals
        least = np.cos(np.radians(CREASE_DEG))
        corners = self.faces.ravel()
        order = np.argsort(corners, kind="stable")
        degree = np.bincount(corners, minlength=len(self.vertices))
        begin = np.cumsum(degree) - degree
        crowded = (degree > MOST_AROUND)[corners]
        total = crossed.repeat(3, axis=0) * crowded[:, np.newaxis]
        few = np.where(degree > MOST_AROUND, 0, degree)
        for turn in range(int(few.max())):
            has = turn < few[corners]
            other = order[begin[corners[has]] + turn] // 3
            own = np.flatnonzero(has) // 3
            cosine = np.einsum("ij,ij->i", unit[own], unit[other])
            alike = np.abs(cosine) >= least
            added = crossed[other[alike]] * np.sign(cosine[alike])[:, np.newaxis]
            total[np.flatnonzero(has)[alike]] += added
        length = np.linalg.norm(total, axis=1, keepdims=True)
        total = np.where(length > 0.0, total / np.where(length > 0, length, 1), 0.0)
        normals: Float32Array = total.reshape(-1, 3, 3).astype(np.float32)
        return normals

    @cached_property
    def vertex_normals(self) -> FloatArray:
        """Unit normals of the vertices, shape (v, 3); sides may differ from faces'."""
        corners = self.faces.ravel()
        normals = self.corner_normals.reshape(-1, 3).astype(np.float64)
        first = np.zeros((len(self.vertices), 3))
        first[corners[::-1]] = normals[::-1]
        alike = np.einsum("ij,ij->i", normals, first[corners]) >= 0.0
        total = np.zeros_like(first)
        np.add.at(total, corners, np.where(alike[:, None], normals, -normals))
        unit: FloatArray = total / np.maximum(
            np.linalg.norm(total, axis=1, keepdims=True), 1e-12
        )
        return unit

    @cached_property
    def face_normals(self) -> tuple[FloatArray, FloatArray]:
        """Normals of the triangles, as long as their area and of length 1."""
        a, b, c = (self.vertices[self.faces[:, corner]] for corner in range(3))
        crossed = np.cross(b - a, c - a)
        length = np.linalg.norm(crossed, axis=1, keepdims=True)
        return crossed, crossed / np.maximum(length, 1e-30)


def checked(vertices: FloatArray, faces: NDArray[np.intp], name: str) -> Mesh:
    """A mesh brought to the middle and to size 1, without its empty triangles.

    Raises
    ------
    PreviewError
        When there is nothing to draw, or too much.
    """
    if len(faces) > MOST_TRIANGLES:
        msg = (
            f"{name} has {len(faces)} triangles, more than {MOST_TRIANGLES}: "
            "reduce it in the program it came from"
        )
        raise PreviewError(msg)
    if not np.isfinite(vertices).all():
        msg = f"{name} has vertices that are not numbers: export it again"
        raise PreviewError(msg)
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    faces = faces[area > 0.0]
    if not len(faces):
        msg = f"{name} has no triangles with an area: there is nothing to draw"
        raise PreviewError(msg)
    used, again = np.unique(faces, return_inverse=True)
    vertices = vertices[used]
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    centred = vertices - middle
    reach = np.hypot(centred[:, 0], centred[:, 2]).max()
    size = max(reach, np.abs(centred[:, 1]).max())
    return Mesh(centred / size, again.reshape(-1, 3))
