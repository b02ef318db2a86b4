"""A paint out of a painting: Lab at the wanted angles from the pixels that show it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from paintlink.color import Curve, drawing_curve
from paintlink.model import FloatArray, Lab
from paintlink.sketch.cells import Cells, Pixels, pixels
from paintlink.sketch.evidence import Evidence, evidence
from paintlink.sketch.floor import floor, misfit
from paintlink.sketch.local import LocalValue, half_width_deg, local_value
from paintlink.sketch.paper_fit import paper_lab, paper_rgb
from paintlink.sketch.reference import without_strays
from paintlink.sketch.refusals import require_paint
from paintlink.sketch.result import AngleFit, SketchFit
from paintlink.sketch.rounding import unrounded
from paintlink.sketch.selection import CODE, REASONS, Selection, select
from paintlink.sketch.travel import travel_curve
from paintlink.sketch.values import (
    BoolArray,
    Painting,
    PixelArray,
    PixelGeometry,
)

ANGLES_DEG = (15.0, 25.0, 45.0, 75.0, 110.0)
LEAST_EXTRAPOLATED = 2.0
LEAST_OUTSIDE = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class _Found:
    """Pixels of a fit, which of them agree, and the cells of those."""

    pixels: Pixels
    inlier: BoolArray
    cells: Cells
    travel: Curve
    lossy: bool


def fit_painting(
    painting: Painting,
    geometry: PixelGeometry,
    start: PixelArray,
    *,
    exposure: float,
    angles_deg: tuple[float, ...] = ANGLES_DEG,
    name: str = "sketch",
) -> SketchFit:
    """The paint that a painting shows, with what each value rests on.

    Lab at each angle comes from a regression over the pixels near it, once strokes
    that disagree with the rest are set aside; the global quadratic of the paper stands
    beside it for comparison.

    Parameters
    ----------
    start
        Encoded sRGB of the picture the artist began with, shape (height, width, 3).
    exposure
        Linear sRGB of a perfect diffuser facing the light in that picture.

    Raises
    ------
    InputError
        When the pictures do not belong together, or when too little is painted.
    """
    selection = select(painting, geometry, start)
    require_paint(selection)
    taken = (selection.theta_deg, selection.phi, selection.encoded, exposure)
    points = pixels(*taken)
    inlier, cells = without_strays(points)
    fine = unrounded(
        points, inlier, painting=painting, geometry=geometry, selection=selection
    )
    travel = travel_curve(fine, angles_deg)
    found = _Found(points, inlier, fine, travel, painting.lossy)
    rests = evidence(angles_deg, cells, points.theta_deg[inlier], selection.painted_deg)
    angles = tuple(_angle(item, found) for item in rests)
    curve = drawing_curve(angles_deg, [item.lab for item in angles])
    return SketchFit(
        name=name,
        angles=angles,
        travel=found.travel,
        paper_rgb=paper_rgb(*taken),
        paper_lab=paper_lab(*taken),
        floor=floor(points),
        step=selection.step,
        reasons=_with_strays(selection, inlier),
        residual=_residual(painting, geometry, curve, selection.step, exposure),
    )


def _angle(rests: Evidence, found: _Found) -> AngleFit:
    angle = rests.aspecular_deg
    measured = rests.word == "measured"
    value = (
        local_value(found.cells, angle, lossy=found.lossy)
        if measured
        else _carried(found, angle)
    )
    lab, uncertainty = (Lab(*numbers.tolist()) for numbers in value)
    return AngleFit(lab, uncertainty, rests, _outside(found, angle))


def _carried(found: _Found, angle_deg: float) -> LocalValue:
    """The travel curve where nothing is painted; as unsure as it is far from paint."""
    theta = found.cells.theta_deg
    nearest = theta[np.argmin(np.abs(theta - angle_deg))]
    lab, last = found.travel([angle_deg, nearest])
    lab[0] = max(lab[0], 0.0)
    return LocalValue(lab, np.maximum(np.abs(lab - last), LEAST_EXTRAPOLATED))


def _outside(found: _Found, angle_deg: float) -> float:
    """Share of the pixels near the angle that touch the border of sRGB."""
    near = found.inlier & (
        np.abs(found.pixels.theta_deg - angle_deg) < half_width_deg(angle_deg)
    )
    lowest = found.pixels.encoded[near].min(axis=-1, initial=1.0)
    share = np.count_nonzero(lowest < 0.5 * CODE) / max(lowest.size, 1)
    return share if share >= LEAST_OUTSIDE else 0.0


def _with_strays(selection: Selection, inlier: BoolArray) -> np.ndarray:
    reasons = selection.reasons.copy()
    kept = np.flatnonzero(reasons == REASONS.index("kept"))
    reasons.flat[kept[~inlier]] = REASONS.index("stray")
    reasons.setflags(write=False)
    return reasons


def _residual(
    painting: Painting,
    geometry: PixelGeometry,
    curve: Curve,
    step: int,
    exposure: float,
) -> FloatArray:
    thin = np.s_[::step, ::step]
    mask = geometry.mask[thin]
    residual = np.full(mask.shape, np.nan)
    theta = geometry.theta_deg[thin][mask]
    phi = geometry.phi[thin][mask].astype(np.float64)
    encoded = painting.encoded[thin][mask].astype(np.float64)
    residual[mask] = misfit(encoded, curve(theta), phi, exposure)
    residual.setflags(write=False)
    return residual
