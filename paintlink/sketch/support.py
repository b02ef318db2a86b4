"""Whether a pose lets an artist paint a wanted aspecular angle at all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.pose import Pose
from paintlink.sketch.values import PixelGeometry

LEAST_PHI = 0.15
LEAST_SHARE = 1e-4
SURVEY_SIZE = 512
WINDOWS_DEG = {15.0: 9.0, 25.0: 10.0, 45.0: 10.0, 75.0: 14.0, 110.0: 22.0}
USUAL_WINDOW_DEG = 10.0


def survey(pose: Pose) -> PixelGeometry:
    """Geometry of the pose at a size that is enough to judge it."""
    return pixel_geometry(Pose(pose.object, pose.light, SURVEY_SIZE))


def unsupported(
    geometry: PixelGeometry, angles_deg: Sequence[float]
) -> tuple[float, ...]:
    """Angles without enough well lit pixels on both sides of them.

    A pixel is well lit where phi is at least 0.15; enough is 0.01 % of the picture
    within the window that a value is later taken from.
    """
    lit = geometry.mask & (geometry.phi >= LEAST_PHI)
    theta = geometry.theta_deg[lit]
    least = LEAST_SHARE * geometry.mask.size
    return tuple(angle for angle in angles_deg if _thinner(theta, angle) < least)


def _thinner(theta: np.ndarray, angle_deg: float) -> int:
    """Number of pixels on the side of the angle that has fewer."""
    reach = WINDOWS_DEG.get(angle_deg, USUAL_WINDOW_DEG)
    near = theta[np.abs(theta - angle_deg) < reach]
    above = int(np.count_nonzero(near > angle_deg))
    return min(above, near.size - above)
