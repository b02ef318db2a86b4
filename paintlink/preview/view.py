"""From where the object is looked at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.preview.arrays import Float32Array


@dataclass(frozen=True)
class View:
    """A direction of looking, upright.

    Parameters
    ----------
    pitch_deg
        How far above the horizon the viewer stands, -80 to 80.
    yaw_deg
        How far to the right of the front, -180 to 180.
    """

    pitch_deg: float = 0.0
    yaw_deg: float = 0.0

    @property
    def axes(self) -> Float32Array:
        """Right, up and towards the viewer in the world, rows of shape (3, 3)."""
        pitch, yaw = np.radians([self.pitch_deg, self.yaw_deg])
        towards = [
            np.cos(pitch) * np.sin(yaw),
            np.sin(pitch),
            np.cos(pitch) * np.cos(yaw),
        ]
        right = [np.cos(yaw), 0.0, -np.sin(yaw)]
        return np.array([right, np.cross(towards, right), towards], dtype=np.float32)

    def inward(self, directions: Float32Array) -> Float32Array:
        """World directions, shape (n, 3), as the viewer sees them."""
        seen: Float32Array = directions @ self.axes.T
        return seen

    def outward(self, directions: Float32Array) -> Float32Array:
        """The viewer's directions, shape (n, 3), in the world."""
        world: Float32Array = directions @ self.axes
        return world


FRONT = View()
