"""A sketch beside the paint that was read out of it, as one picture.

A way of showing the result: nothing is decided here.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from paintlink.model import FloatArray
from paintlink.sketch.result import SketchFit
from paintlink.sketch.transfer import shown
from paintlink.sketch.values import Painting, PixelArray, PixelGeometry

if TYPE_CHECKING:
    from PIL.Image import Image as Drawing

PANEL_PX = 360
GAP_PX = 10
LINE_PX = 22
SCALE_END = 10.0
"""CIEDE2000 at the far end of the residual's colours."""

PAPER = (246, 246, 245)
INK = (38, 38, 40)
SCALE = np.array([
    (0.13, 0.17, 0.30), (0.16, 0.44, 0.56), (0.52, 0.71, 0.49),
    (0.96, 0.80, 0.35), (0.86, 0.36, 0.18), (0.55, 0.06, 0.12),
])  # fmt: skip


class Panel(NamedTuple):
    """An encoded sRGB picture, values 0 to 1, and the words below it."""

    encoded: PixelArray
    caption: str


def report_picture(
    fit: SketchFit, painting: Painting, geometry: PixelGeometry, exposure: float
) -> NDArray[np.uint8]:
    """Sketch, render of the fit and residual side by side, with words below.

    Shape (height, width, 3), encoded sRGB.
    """
    mean = float(np.nanmean(fit.residual))
    return side_by_side(
        [
            Panel(painting.encoded, "sketch"),
            Panel(
                rendered(fit, painting, geometry, exposure),
                f"{fit.name}, mean dE00 {mean:.1f}",
            ),
            residual_panel(fit),
        ],
        lines=fit.notes,
    )


def rendered(
    fit: SketchFit, painting: Painting, geometry: PixelGeometry, exposure: float
) -> FloatArray:
    """The sketch with the fitted paint in place of the artist's, thinned alike."""
    thin = np.s_[:: fit.step, :: fit.step]
    encoded = np.array(painting.encoded[thin], dtype=np.float64)
    mask = geometry.mask[thin]
    lab = fit.curve(geometry.theta_deg[thin][mask])
    phi = geometry.phi[thin][mask].astype(np.float64)
    encoded[mask] = shown(lab, phi, exposure)
    return encoded


def residual_panel(fit: SketchFit) -> Panel:
    """The residual in colours, with the scale they are read by along the bottom."""
    encoded = coloured(fit.residual)
    bar = max(4, encoded.shape[0] // 30)
    ramp = np.linspace(0.0, SCALE_END, encoded.shape[1])
    encoded[-bar:] = coloured(ramp)[np.newaxis]
    caption = f"residual, scale dE00 0 to {SCALE_END:g} and more"
    return Panel(encoded, caption)


def coloured(residual: FloatArray) -> FloatArray:
    """Encoded colours of colour differences, paper where there is none."""
    places = np.linspace(0.0, SCALE_END, len(SCALE))
    values = np.nan_to_num(residual)
    channels = [np.interp(values, places, column) for column in SCALE.T]
    known = np.isfinite(residual)[..., np.newaxis]
    return np.where(known, np.stack(channels, axis=-1), np.array(PAPER) / 255.0)


def side_by_side(
    panels: Sequence[Panel], lines: Sequence[str] = ()
) -> NDArray[np.uint8]:
    """Pictures in a row, equally high, each with its caption, above lines of text.

    Shape (height, width, 3), encoded sRGB.
    """
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.load_default(13)
    images = [_image(panel.encoded) for panel in panels]
    width = sum(image.width + GAP_PX for image in images) + GAP_PX
    sheet = Image.new(
        "RGB", (width, PANEL_PX + 2 * GAP_PX + LINE_PX * (1 + len(lines))), PAPER
    )
    pencil = ImageDraw.Draw(sheet)
    left = GAP_PX
    for image, panel in zip(images, panels, strict=True):
        sheet.paste(image, (left, GAP_PX))
        place = (left + image.width / 2, PANEL_PX + GAP_PX + 13)
        pencil.text(place, panel.caption, fill=INK, font=font, anchor="mm")
        left += image.width + GAP_PX
    for number, line in enumerate(lines, 1):
        place = (width / 2, PANEL_PX + GAP_PX + 13 + LINE_PX * number)
        pencil.text(place, line, fill=INK, font=font, anchor="mm")
    return np.asarray(sheet)


def _image(encoded: PixelArray) -> Drawing:
    """The panel's picture at the common height."""
    from PIL import Image

    image = Image.fromarray(np.rint(255.0 * encoded).astype(np.uint8))
    width = round(image.width * PANEL_PX / image.height)
    return image.resize((width, PANEL_PX), Image.Resampling.LANCZOS)
