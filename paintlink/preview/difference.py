"""Where two paints look unlike on an object, and how much."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from paintlink.color import ciede2000, white, xyz_to_lab
from paintlink.color.display import XYZ_TO_SRGB
from paintlink.model import ColorSpec, FloatArray
from paintlink.preview.picture import Picture
from paintlink.preview.render import render

STOPS = (0.0, 1.0, 2.0, 4.0, 8.0)
COLOURS = (
    (38, 52, 92), (54, 126, 140), (142, 190, 90), (240, 200, 70), (200, 50, 40),
)  # fmt: skip
SCALE_SHARE = 1 / 24


def difference_map(
    first: ColorSpec,
    second: ColorSpec,
    *,
    object: str = "panel",
    light: str = "studio",
    size: int = 512,
    cache_dir: Path | None = None,
) -> tuple[Picture, FloatArray]:
    """The object in false colours of the difference, and the differences themselves.

    CIEDE2000 between what the two paints send to the viewer, the perfect diffuser of
    the picture being white. The lowest rows are the scale: 0, 1, 2, 4, 8 and above.

    Returns
    -------
    The picture, and differences of shape (size, size), 0 beside the object.
    """
    both = [
        render(
            [spec],
            object=object,
            light=light,
            size=size,
            backend="cpu",
            cache_dir=cache_dir,
            linear=True,
        )
        for spec in (first, second)
    ]
    labs = [_lab(picture.required_linear()) for picture in both]
    difference = ciede2000(*labs)
    rgb = false_colours(difference)
    rgb[_scale_rows(size)] = false_colours(_scale(size))
    largest = f"largest difference {difference.max():.1f} dE00 on the object"
    notes = (*both[0].notes, largest, "scale 0 1 2 4 8 dE00 and above")
    return replace(both[0], rgb=rgb, specs=(first, second), notes=notes), difference


def false_colours(difference: FloatArray) -> NDArray[np.uint8]:
    """Colours of differences, shape (..., 3)."""
    channels = [
        np.interp(difference, STOPS, [colour[channel] for colour in COLOURS])
        for channel in range(3)
    ]
    return np.rint(np.stack(channels, axis=-1)).astype(np.uint8)


def _lab(linear: NDArray[np.float32]) -> FloatArray:
    xyz = np.linalg.solve(XYZ_TO_SRGB, linear.reshape(-1, 3).T.astype(np.float64)).T
    lab: FloatArray = xyz_to_lab(100.0 * xyz, white("D65", "2")).reshape(linear.shape)
    return lab


def _scale_rows(size: int) -> slice:
    return slice(size - max(4, round(size * SCALE_SHARE)), size)


def _scale(size: int) -> FloatArray:
    """Differences along the width, every stop of the scale as far from the next."""
    return np.interp(np.linspace(0, len(STOPS) - 1, size), range(len(STOPS)), STOPS)
