"""How far a painting is from the pictures that paints can make."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from paintlink.color import ciede2000, lab_to_linear_srgb
from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells, Pixels, median_cells
from paintlink.sketch.reference import profile
from paintlink.sketch.transfer import decode_srgb, linear_srgb_to_lab, shown

BIN_DEG = 2.0
GOOD = 2.0
USABLE = 5.0


class Floor(NamedTuple):
    """Mean CIEDE2000 between a painting and the best picture any paint could make."""

    mean: float

    @property
    def consistent(self) -> bool:
        """Whether the painting can be a paint at all."""
        return self.mean <= USABLE

    @property
    def sentence(self) -> str:
        """What the number means to the person who painted."""
        best = f"best possible is dE00 {self.mean:.1f}"
        if self.mean <= GOOD:
            return f"a paint can look like this: {best}"
        if self.consistent:
            return f"a paint can look roughly like this: {best}"
        return (
            f"no paint looks like this: {best}; "
            "paint with the light, so that the shading follows the form"
        )


def floor(pixels: Pixels) -> Floor:
    """Misfit that is left when Lab may be any function of the aspecular angle.

    Taken between cells, not pixels: the noise of a brush and a few strokes are no
    reason to blame the light.
    """
    cells = median_cells(pixels)
    if not cells.count.size:
        return Floor(0.0)
    painted = shown(cells.lab, cells.phi, pixels.exposure)
    free = best_lab(cells, cells.theta_deg)
    left = misfit(painted, free, cells.phi, pixels.exposure)
    return Floor(float(np.average(left, weights=cells.count)))


def best_lab(cells: Cells, theta_deg: FloatArray) -> FloatArray:
    """Lab of the paint that comes nearest when its curve may have any shape."""
    return profile(cells, BIN_DEG)(theta_deg)


def misfit(
    encoded: FloatArray, lab: FloatArray, phi: FloatArray, exposure: float
) -> FloatArray:
    """CIEDE2000 of each pixel between a painting and paint of this reflectance.

    Both as they are displayed: what is clipped on the screen cannot differ.
    """
    linear = (exposure * phi)[..., np.newaxis] * lab_to_linear_srgb(lab)
    painted = linear_srgb_to_lab(decode_srgb(encoded))
    return ciede2000(painted, linear_srgb_to_lab(np.clip(linear, 0.0, 1.0)))
