"""A painting read back: the picture, where it lies, and what it was painted on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from paintlink.errors import InputError
from paintlink.model import FloatArray
from paintlink.preview.arrays import Float32Array
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.geometry_picture import differs, from_values, geometry_codes
from paintlink.sketch.pictures import read_picture
from paintlink.sketch.png import to_values
from paintlink.sketch.pose import SIZES, Pose
from paintlink.sketch.recipe import Recipe
from paintlink.sketch.registration import Shift, registered, require_upright
from paintlink.sketch.start import start_codes
from paintlink.sketch.strip import PATCHES, read_strip, strip_fits
from paintlink.sketch.values import Painting, PixelGeometry

MOST_STRIP_CODES = 4
MOST_STRIP_CODES_LOSSY = 8
LEAST_LIKENESS = 0.85


@dataclass(frozen=True, slots=True, eq=False)
class Sketch:
    """What a fit needs, all in the frame of the painting as it was saved."""

    painting: Painting
    geometry: PixelGeometry
    start: Float32Array
    recipe: Recipe


def read_back(path: Path, recipe: Recipe) -> Sketch:
    """The painting in a file, with geometry and start picture computed where it lies.

    The painting itself is never resampled: for a moved picture, or one of another
    size, the geometry is computed anew.

    Raises
    ------
    InputError
        When the file cannot be read or shows the object otherwise than the recipe.
    """
    painting = read_picture(path)
    try:
        return _placed(painting, recipe)
    except InputError as error:
        msg = f"{path}: {error}"
        raise InputError(msg) from error


def read_geometry_picture(path: Path) -> PixelGeometry:
    """Geometry from a picture, for an object this program does not know.

    Raises
    ------
    InputError
        When the picture cannot be read, or its numbers were changed by a program.
    """
    picture = _numbers(path)
    try:
        return from_values(picture)
    except InputError as error:
        msg = f"{path}: {error}"
        raise InputError(msg) from error


def altered_geometry(path: Path, recipe: Recipe) -> str:
    """What is wrong with a geometry picture beside its recipe; empty when nothing."""
    codes = geometry_codes(pixel_geometry(recipe.pose), recipe.bits)
    try:
        values = _numbers(path)
    except InputError as error:
        return f"{error}; the recipe is used instead"
    if differs(values, codes):
        return f"{path} was changed since the set-up; the recipe is used instead"
    return ""


def _numbers(path: Path) -> Float32Array:
    """Samples of a picture of numbers, 0 to 1; refused with a profile or with loss."""
    picture = read_picture(path)
    if picture.lossy or picture.notes:
        msg = (
            f"{path}: geometry has to come as RGB in PNG or TIFF, without a colour "
            "profile: use the geometry.png of the set-up"
        )
        raise InputError(msg)
    return picture.encoded.astype(np.float32)


def _placed(painting: Painting, recipe: Recipe) -> Sketch:
    pose = _pose(painting, recipe)
    require_upright(painting.encoded)
    shift = registered(painting.encoded, pose)
    place = (shift.right_px, shift.down_px)
    geometry = pixel_geometry(pose, place)
    start = to_values(start_codes(replace(recipe, pose=pose), geometry, place))
    notes = (*painting.notes, *_notes(painting, recipe, shift))
    return Sketch(replace(painting, notes=notes), geometry, start, recipe)


def _pose(painting: Painting, recipe: Recipe) -> Pose:
    """The pose at the size the painting has."""
    height, width, _ = painting.encoded.shape
    if height != width or width not in SIZES:
        size = recipe.pose.size
        msg = (
            f"{width} x {height} pixels, but the start picture has {size} x {size}: "
            "save it at that size, without cropping"
        )
        raise InputError(msg)
    return replace(recipe.pose, size=width)


def _notes(painting: Painting, recipe: Recipe, shift: Shift) -> Iterator[str]:
    size = len(painting.encoded)
    if size != recipe.pose.size:
        yield f"{size} pixels wide instead of {recipe.pose.size}: taken as resampled"
    if not shift.is_none:
        yield (
            f"moved by {shift.right_px:+.1f} px to the right and {shift.down_px:+.1f} "
            "px down: put right"
        )
    yield from _strip_notes(painting, shift)


def _strip_notes(painting: Painting, shift: Shift) -> Iterator[str]:
    """What the control strip tells about the colours of the whole picture."""
    place = (shift.right_px, shift.down_px)
    if not strip_fits(len(painting.encoded), place):
        yield "the control strip was cut off: colour changes cannot be noticed"
        return
    seen = read_strip(painting.encoded, place)
    off = 255.0 * float(np.abs(seen - PATCHES).max())
    limit = MOST_STRIP_CODES_LOSSY if painting.lossy else MOST_STRIP_CODES
    if off <= limit:
        return
    if _likeness(seen) < LEAST_LIKENESS:
        yield "the control strip was painted over: colour changes cannot be noticed"
        return
    yield (
        f"the control strip is off by up to {off:.0f} codes of 255: the whole picture "
        "was converted or corrected; if you did not mean that, save it as sRGB"
    )


def _likeness(seen: FloatArray) -> float:
    """Correlation of the strip as it is with the strip as it was."""
    if seen.std() == 0.0:
        return 0.0
    return float(np.corrcoef(seen.ravel(), PATCHES.ravel())[0, 1])
