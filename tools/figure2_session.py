"""Replay the paper's Figure 2 session and draw docs/images/figure2.png.

Usage: ``python tools/figure2_session.py [FILE]``. A metallic is drawn on a curved
panel; the painting steps of the caption are done by formula instead of by hand; the
goal is saved with 8 bits a channel and fitted. A second session fills the object with
one straight gradient, against the light, to show that no paint looks like that.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from paintlink.color import Curve, ciede2000, drawing_curve
from paintlink.color.display import LUMINANCE, encode_srgb
from paintlink.model import ColorSpec, FloatArray, Lab, Sample
from paintlink.sketch.cells import median_cells, pixels
from paintlink.sketch.fit import fit_painting
from paintlink.sketch.floor import best_lab, misfit
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.pose import USUAL_LIGHTS, Pose
from paintlink.sketch.report import Panel, rendered, residual_panel, side_by_side
from paintlink.sketch.result import SketchFit
from paintlink.sketch.start import GREY, exposure_for
from paintlink.sketch.transfer import decode_srgb, linear_srgb_to_lab, shown
from paintlink.sketch.values import Painting, PixelGeometry

TARGET = Path(__file__).resolve().parents[1] / "docs" / "images" / "figure2.png"
SIZE = 512

OBJECTS = ("panel", "sphere")
FORM, STRAIGHT = "follows the form", "straight gradient"
STARTING_PAINT = ColorSpec(
    "silver blue",
    (
        Sample(15.0, Lab(95, -3, -8)),
        Sample(45.0, Lab(52, -2, -12)),
        Sample(110.0, Lab(22, -1, -12)),
    ),
)
FLOP = np.array([0.30, 0.05, 0.05])
FACE = np.array([0.90, 0.42, 0.30])
YELLOW = np.array([1.0, 0.95, 0.35])
HUE_TURN = 110.0 / 360.0
DABS = 60
DAB_FLOW = 0.06
FACE_SHARE = 0.07


class Session(NamedTuple):
    """What an artist had, what came of it, and what was read out of that."""

    geometry: PixelGeometry
    exposure: float
    start: FloatArray
    goal: FloatArray
    fit: SketchFit
    floor: float


def main() -> None:
    """Replay both sessions on both objects, print the figures, draw the first."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET
    sessions = {
        (shape, way): replay(geometry_of(shape), straight=way == STRAIGHT)
        for shape in OBJECTS
        for way in (FORM, STRAIGHT)
    }
    for (shape, way), session in sessions.items():
        print(f"{shape}, {way}: {figures(session)}")
    draw(sessions["panel", FORM], target)


def geometry_of(shape: str) -> PixelGeometry:
    """Geometry of an object in its usual light."""
    return pixel_geometry(Pose(shape, USUAL_LIGHTS[shape], SIZE))


def replay(geometry: PixelGeometry, *, straight: bool = False) -> Session:
    """One session: draw the start, paint the goal on it, fit."""
    curve = drawing_curve(STARTING_PAINT.angles_deg, STARTING_PAINT.lab())
    exposure = exposure_for(STARTING_PAINT, geometry)
    start = drawn(curve, geometry, exposure)
    goal = np.rint(255.0 * painted(start, geometry, straight=straight)) / 255.0
    fit = fit_painting(
        Painting(goal), geometry, start, exposure=exposure, name="fitted paint"
    )
    return Session(
        geometry, exposure, start, goal, fit, floor(goal, geometry, exposure)
    )


def floor(goal: FloatArray, geometry: PixelGeometry, exposure: float) -> float:
    """Mean CIEDE2000 over all pixels of the object to the best picture of any paint."""
    mask = geometry.mask
    theta = geometry.theta_deg[mask].astype(np.float64)
    phi = geometry.phi[mask].astype(np.float64)
    painted = pixels(theta, phi, goal[mask], exposure)
    best = best_lab(median_cells(painted), theta)
    return float(misfit(goal[mask], best, phi, exposure).mean())


def figures(session: Session) -> str:
    """Distances over the whole object, in words."""
    mask = session.geometry.mask
    moved = ciede2000(
        linear_srgb_to_lab(decode_srgb(session.start[mask])),
        linear_srgb_to_lab(decode_srgb(session.goal[mask])),
    )
    left = session.fit.residual[np.isfinite(session.fit.residual)]
    papers = ", ".join(
        f"{name} {misfit_of(session, curve):.1f}"
        for name, curve in (
            ("paper RGB", session.fit.paper_rgb.lab),
            ("paper Lab", session.fit.paper_lab.lab),
        )
    )
    return (
        f"start to goal {moved.mean():.0f}, floor {session.floor:.1f}, fit "
        f"{left.mean():.1f} (p90 {np.percentile(left, 90):.1f}), {papers}; "
        f"{session.fit.floor.sentence}"
    )


def misfit_of(session: Session, lab_at: Callable[[FloatArray], FloatArray]) -> float:
    """Mean CIEDE2000 over the object when it is painted with another fit."""
    geometry, mask = session.geometry, session.geometry.mask
    theta = geometry.theta_deg[mask].astype(np.float64)
    phi = geometry.phi[mask].astype(np.float64)
    left = misfit(session.goal[mask], lab_at(theta), phi, session.exposure)
    return float(left.mean())


def draw(session: Session, target: Path) -> None:
    """The paper's three pictures and the residual, side by side."""
    from PIL import Image

    goal = Painting(session.goal)
    render = rendered(session.fit, goal, session.geometry, session.exposure)
    mean = float(np.nanmean(session.fit.residual))
    sheet = side_by_side([
        Panel(session.start, "start picture"),
        Panel(session.goal, "goal, painted"),
        Panel(render, f"paint fitted to it, mean dE00 {mean:.1f}"),
        residual_panel(session.fit),
    ])
    target.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(sheet).save(target, optimize=True)


def painted(
    start: FloatArray, geometry: PixelGeometry, *, straight: bool
) -> FloatArray:
    """The goal: gradient, burn, hue and yellow dabs inside the mask, encoded."""
    light = decode_srgb(start) @ LUMINANCE
    mask = geometry.mask
    along = downwards(mask) if straight else encode_srgb(light / light[mask].max())
    flop_to_face = np.clip(along, 0.0, 1.0)[..., np.newaxis]
    colour = FLOP + flop_to_face * (FACE - FLOP)
    burn = 1.0 - 0.45 * np.clip(1.0 - (colour @ LUMINANCE) / 0.35, 0.0, 1.0)
    colour = hue_turned(colour * burn[..., np.newaxis], HUE_TURN)
    colour = dabbed(colour, np.where(mask, light, 0.0))
    return np.where(mask[..., np.newaxis], colour, start)


def downwards(mask: np.ndarray) -> FloatArray:
    """1 at the top of the object, 0 at its bottom."""
    rows = np.flatnonzero(mask.any(axis=1))
    along = (rows[-1] - np.arange(mask.shape[0])) / (rows[-1] - rows[0])
    return np.broadcast_to(along[:, np.newaxis], mask.shape)


def hue_turned(rgb: FloatArray, turn: float) -> FloatArray:
    """The colours with their HSV hue turned by a fraction of the circle."""
    value = rgb.max(axis=-1)
    chroma = value - rgb.min(axis=-1)
    red, green, blue = np.moveaxis(rgb, -1, 0)
    size = np.where(chroma > 0.0, chroma, 1.0)
    sextant = np.select(
        [value == red, value == green],
        [(green - blue) / size, 2.0 + (blue - red) / size],
        4.0 + (red - green) / size,
    )
    hue = sextant / 6.0 + turn
    place = (np.array([5.0, 3.0, 1.0]) + 6.0 * hue[..., np.newaxis]) % 6.0
    share = np.clip(np.minimum(place, 4.0 - place), 0.0, 1.0)
    turned: FloatArray = value[..., np.newaxis] - chroma[..., np.newaxis] * share
    return turned


def dabbed(colour: FloatArray, light: FloatArray) -> FloatArray:
    """Soft yellow dabs of low flow where the object is brightest."""
    rng = np.random.default_rng(2)
    lit = light[light > 0.0]
    bright = np.argwhere(light >= np.quantile(lit, 1.0 - FACE_SHARE))
    rows, columns = np.indices(light.shape)
    for row, column in bright[rng.integers(0, len(bright), DABS)]:
        far = ((rows - row) ** 2 + (columns - column) ** 2) / (0.04 * SIZE) ** 2
        flow = DAB_FLOW * np.exp(-far)[..., np.newaxis]
        colour = colour + flow * (YELLOW - colour)
    return colour


def drawn(curve: Curve, geometry: PixelGeometry, exposure: float) -> FloatArray:
    """Encoded start picture of a paint before a grey background."""
    mask = geometry.mask
    encoded = np.full((*mask.shape, 3), GREY)
    phi = geometry.phi[mask].astype(np.float64)
    encoded[mask] = shown(curve(geometry.theta_deg[mask]), phi, exposure)
    return encoded


if __name__ == "__main__":
    main()
