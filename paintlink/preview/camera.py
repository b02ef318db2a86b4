"""How a mesh is looked at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.preview.backdrop import floor_and_wall
from paintlink.preview.mesh import Mesh
from paintlink.preview.occlusion import Occlusion
from paintlink.preview.view import View

FILLED = 0.88
"""Share of the picture's half width or height the object fills."""

FIELD_DEG = 28.0


@dataclass(frozen=True)
class Camera:
    """Where the viewer stands.

    Parameters
    ----------
    pitch_deg
        How far above the horizon.
    turn_deg
        How far the object is turned about its upright axis, against the clock as seen
        from above.
    perspective
        Whether near things look larger; otherwise the viewer is far away.
    """

    pitch_deg: float = 10.0
    turn_deg: float = 0.0
    perspective: bool = False

    @property
    def view(self) -> View:
        """Direction of the middle of the picture."""
        return View(self.pitch_deg)

    def turned(self, points: FloatArray) -> FloatArray:
        """Points or normals of the object, shape (..., 3), in the world."""
        turn = np.radians(self.turn_deg)
        cosine, sine = np.cos(turn), np.sin(turn)
        turned: FloatArray = points @ np.array([
            [cosine, 0.0, -sine],
            [0.0, 1.0, 0.0],
            [sine, 0.0, cosine],
        ])
        return turned

    @property
    def distance(self) -> float:
        """From the viewer to the middle of an object of size 1."""
        return 1.15 / float(np.sin(np.radians(FIELD_DEG / 2.0)))


class Eye:
    """The projection of one mesh."""

    def __init__(self, mesh: Mesh, camera: Camera) -> None:
        self._camera = camera
        self._axes = camera.view.axes.astype(np.float64)
        reach = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 2]).max()
        self._floor = mesh.vertices[:, 1].min()
        pitch = np.radians(camera.pitch_deg)
        tall = -self._floor * np.cos(pitch) + reach * np.sin(pitch)
        self._zoom = FILLED / max(reach, tall)

    def placed(self, mesh: Mesh) -> FloatArray:
        """Picture x and y from -1 to 1, and nearness, of the vertices, (v, 3)."""
        seen = self.seen(mesh.vertices)
        if not self._camera.perspective:
            flat: FloatArray = seen * [self._zoom, self._zoom, 1.0]
            return flat
        nearness = 1.0 / (self._camera.distance - seen[:, 2])
        scale = self._zoom * self._camera.distance * nearness
        return np.stack([seen[:, 0] * scale, seen[:, 1] * scale, nearness], axis=1)

    def seen(self, points: FloatArray) -> FloatArray:
        """Points or directions of the object as the viewer sees them, (..., 3)."""
        seen: FloatArray = self._camera.turned(points) @ self._axes.T
        return seen

    def towards(self, points: FloatArray) -> Float32Array | None:
        """Unit directions from points to the viewer, (n, 3); None when all alike."""
        if not self._camera.perspective:
            return None
        away = [0.0, 0.0, self._camera.distance] - self.seen(points)
        away /= np.linalg.norm(away, axis=1, keepdims=True)
        return away.astype(np.float32)

    def behind(self, shade: Occlusion, x: FloatArray, y: FloatArray) -> FloatArray:
        """Grey of wall and floor with the shade of the object."""
        across, towards = self._floor_seen(x / self._zoom, y / self._zoom)
        turn = np.radians(self._camera.turn_deg)
        local_x = across * np.cos(turn) - towards * np.sin(turn)
        local_z = across * np.sin(turn) + towards * np.cos(turn)
        return floor_and_wall(x, y, shade.on_floor(local_x, local_z))

    def _floor_seen(
        self, right: FloatArray, up: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """World x and z where the floor is seen, far away where it is not."""
        pitch = np.radians(self._camera.pitch_deg)
        cosine, sine = np.cos(pitch), max(np.sin(pitch), 1e-3)
        if not self._camera.perspective:
            along = (self._floor - up * cosine) / sine
            return right, along * cosine - up * sine
        distance = self._camera.distance
        falling = np.minimum(up / distance * cosine - sine, -1e-3)
        along = (self._floor - distance * sine) / falling
        return (
            along * right / distance,
            distance * cosine - along * (cosine + up / distance * sine),
        )


def span(mesh: Mesh, camera: Camera) -> tuple[float, float]:
    """Left and right end of the mesh in the picture, -1 to 1."""
    across = Eye(mesh, camera).placed(mesh)[:, 0]
    return float(across.min()), float(across.max())
