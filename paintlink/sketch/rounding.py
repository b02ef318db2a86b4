"""Taking back what the file did to the pixels, by saving the fit the same way.

Eight bits keep a dark flop a handful of codes deep, and a JPEG keeps the colour of a
smooth grey in whole codes: averages over many pixels keep that bias. So the fit is
drawn, saved as the painting was, and what saving changed is taken off the painting;
a fit of what is left replaces the first, a few times.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.sketch.cells import Cells, Pixels, mean_cells
from paintlink.sketch.local import HELD_FROM_DEG, local_value
from paintlink.sketch.selection import CODE, REASONS, Selection
from paintlink.sketch.storage import Storage
from paintlink.sketch.transfer import shown
from paintlink.sketch.travel import travel_curve
from paintlink.sketch.values import BoolArray, Painting, PixelGeometry

LabCurve = Callable[[FloatArray], FloatArray]
"""Lab of aspecular degrees, shape (n, 3)."""

ROUNDS, ROUNDS_SPREADING = 2, 8
MOST_LEFT = 1.0 * CODE
"""Mean misfit beyond which brushwork, not the file, decides; it dithers by itself."""

STROKE = 12.0 * CODE
SAVED_PIXELS = 160_000
BAND_ROWS = 32
BLURRED_ROWS = 2
"""Rows beside a cut that upsampling of the chroma reaches."""

KNOTS_DEG = np.concatenate([np.arange(13.0, 41.0, 3.0), np.arange(45.0, 111.0, 5.0)])

Saved = Callable[[LabCurve], FloatArray]
"""What saving a paint does to each pixel of a sample, encoded sRGB, shape (n, 3)."""


@dataclass(frozen=True, slots=True, eq=False)
class _Sample:
    """Pixels that are compared with the saved fit, and which of them agree."""

    points: Pixels
    inlier: BoolArray
    change: Saved

    def drawn(self, curve: LabCurve) -> FloatArray:
        points = self.points
        return shown(curve(points.theta_deg), points.phi, points.exposure)

    def without(self, curve: LabCurve) -> Cells:
        """Cells of what the pixels were before the file changed them."""
        encoded = self.points.encoded - self.change(curve)
        return mean_cells(replace(self.points, encoded=encoded), self.inlier)

    def left(self, curve: LabCurve) -> float:
        """Mean misfit of the saved fit to the painting, encoded."""
        left = self.points.encoded - self.drawn(curve) - self.change(curve)
        return float(np.abs(left[self.inlier]).mean())


def unrounded(
    points: Pixels,
    inlier: BoolArray,
    *,
    painting: Painting,
    geometry: PixelGeometry,
    selection: Selection,
) -> Cells:
    """Cells of the inliers without what the file's rounding did to them.

    Where nothing is known of the file, or where the painting itself is rougher than
    its rounding, they are the plain means.

    Parameters
    ----------
    points
        The kept pixels of the selection, in its order.
    """
    plain = mean_cells(points, inlier)
    if painting.storage is None or not plain.count.size:
        return plain
    sample = _sample(points, inlier, painting.storage, painting, geometry, selection)
    cells = mean_cells(sample.points, sample.inlier)
    if not cells.count.size:
        return plain
    curves = (_travel, _profile)
    left = [sample.left(curve(cells)) for curve in curves]
    if min(left) > MOST_LEFT:
        return plain
    curve = curves[int(np.argmin(left))]
    for _ in range(ROUNDS_SPREADING if painting.storage.spreads else ROUNDS):
        cells = sample.without(curve(cells))
    return cells


def _travel(cells: Cells) -> LabCurve:
    """The clamped quadratic: few numbers, so that it sees through a coarse file."""
    return travel_curve(cells, (15.0, 45.0, 110.0))


def _profile(cells: Cells) -> LabCurve:
    """A curve through local values, for paints the quadratic cannot follow."""
    lab = np.array([local_value(cells, angle).lab for angle in KNOTS_DEG])
    slope = (lab[1] - lab[0]) / (KNOTS_DEG[1] - KNOTS_DEG[0])
    knots = np.append(0.0, KNOTS_DEG)
    values = np.vstack([lab[0] - KNOTS_DEG[0] * slope, lab])

    def curve(theta_deg: FloatArray) -> FloatArray:
        theta = np.minimum(theta_deg, HELD_FROM_DEG)
        return np.stack([np.interp(theta, knots, row) for row in values.T], axis=-1)

    return curve


def _sample(
    points: Pixels,
    inlier: BoolArray,
    storage: Storage,
    painting: Painting,
    geometry: PixelGeometry,
    selection: Selection,
) -> _Sample:
    if not storage.spreads:
        return _Sample(points, inlier, _each(points, storage))
    rows, whole = _bands(painting.encoded.shape)
    place = np.nonzero(selection.reasons == REASONS.index("kept"))
    down, right = (index * selection.step for index in place)
    among = whole[down]
    chosen = Pixels(
        points.theta_deg[among],
        points.phi[among],
        points.encoded[among],
        points.cell[among],
        points.exposure,
    )
    row = np.searchsorted(rows, down[among])
    change = _within(
        painting.encoded[rows].astype(np.float64),
        geometry.rows(rows),
        storage,
        exposure=points.exposure,
        place=(row, right[among]),
    )
    return _Sample(chosen, inlier[among], change)


def _each(points: Pixels, storage: Storage) -> Saved:
    """Saving changes every pixel by itself."""

    def change(curve: LabCurve) -> FloatArray:
        drawn = shown(curve(points.theta_deg), points.phi, points.exposure)
        changed: FloatArray = storage.again(drawn[:, np.newaxis])[:, 0] - drawn
        return changed

    return change


def _within(
    picture: FloatArray,
    geometry: PixelGeometry,
    storage: Storage,
    *,
    exposure: float,
    place: tuple[NDArray[np.int64], NDArray[np.int64]],
) -> Saved:
    """Saving changes pixels together with their neighbours.

    The fit is drawn wherever the painting is near it; strokes and background stay.
    """
    mask = geometry.mask
    theta = geometry.theta_deg[mask].astype(np.float64)
    phi = geometry.phi[mask].astype(np.float64)
    painted = picture[mask]

    def change(curve: LabCurve) -> FloatArray:
        drawn = shown(curve(theta), phi, exposure)
        near = np.abs(drawn - painted).max(axis=-1) < STROKE
        saved = picture.copy()
        saved[mask] = np.where(near[:, np.newaxis], drawn, painted)
        changed: FloatArray = storage.again(saved)[place] - saved[place]
        return changed

    return change


def _bands(shape: tuple[int, ...]) -> tuple[NDArray[np.int64], BoolArray]:
    """Rows of a picture to save, in bands, and which rows are not beside a cut.

    Bands begin at multiples of the blocks of a JPEG, so that blocks stay whole.
    """
    height, width = shape[:2]
    band = np.arange(height) // BAND_ROWS
    every = max(1, -(-height * width // SAVED_PIXELS))
    chosen = band % every == 0
    reach = range(-BLURRED_ROWS, BLURRED_ROWS + 1)
    padded = np.pad(chosen, BLURRED_ROWS, mode="edge")
    whole = np.all(
        [padded[BLURRED_ROWS + k : BLURRED_ROWS + k + height] for k in reach], axis=0
    )
    return np.flatnonzero(chosen), whole
