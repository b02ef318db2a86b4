"""Set a sketch up: a start picture to paint on, its geometry, and the recipe."""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from paintlink.errors import ExportError
from paintlink.model import ColorSpec
from paintlink.sketch.geometry import pixel_geometry
from paintlink.sketch.geometry_picture import geometry_codes
from paintlink.sketch.png import Codes, sample_bytes, to_png
from paintlink.sketch.pose import Pose
from paintlink.sketch.recipe import Recipe
from paintlink.sketch.recipe_file import write_recipe
from paintlink.sketch.start import beyond_srgb, exposure_for, start_codes
from paintlink.sketch.support import survey, unsupported
from paintlink.spec import spec_id

START, GEOMETRY, RECIPE = "start.png", "geometry.png", "recipe.json"
ANGLES_DEG = (15.0, 25.0, 45.0, 75.0, 110.0)


@dataclass(frozen=True, slots=True)
class SetUp:
    """A recipe, its files by name, and what the artist should know before painting."""

    recipe: Recipe
    files: Mapping[str, bytes]
    warnings: tuple[str, ...]


def set_up(
    paint: ColorSpec,
    pose: Pose,
    *,
    bits: int = 8,
    angles_deg: Sequence[float] = ANGLES_DEG,
) -> SetUp:
    """The files of a sketch that starts from a paint.

    Parameters
    ----------
    bits
        Depth of the pictures, 8 or 16 a channel.
    angles_deg
        Angles the fit will be asked for; those the pose cannot show are warned of.

    Raises
    ------
    InputError
        When depth, object, light or size cannot be had.
    """
    geometry = pixel_geometry(pose)
    exposure = exposure_for(paint, geometry)
    recipe = Recipe(pose, _plain(paint), spec_id(paint), exposure, bits)
    start, numbers = start_codes(recipe, geometry), geometry_codes(geometry, bits)
    recipe = replace(
        recipe, start_sha256=_digest(start), geometry_sha256=_digest(numbers)
    )
    document = write_recipe(recipe)
    files = {
        START: to_png(start, document.decode(), srgb=True),
        GEOMETRY: to_png(numbers, document.decode(), srgb=False),
        RECIPE: document,
    }
    return SetUp(recipe, files, tuple(_warnings(paint, pose, angles_deg)))


def save(made: SetUp, folder: Path) -> None:
    """Write the files into a new folder; it appears complete or not at all.

    Raises
    ------
    ExportError
        When the folder exists and is not empty, or cannot be written.
    """
    folder = folder.absolute()
    temporary = folder.with_name(f".{folder.name}.{os.getpid()}.part")
    try:
        temporary.mkdir(parents=True)
        for name, data in made.files.items():
            (temporary / name).write_bytes(data)
        temporary.rename(folder)
    except OSError as error:
        shutil.rmtree(temporary, ignore_errors=True)
        if folder.exists():
            msg = f"{folder} exists: choose a new folder, so that no sketch is lost"
            raise ExportError(msg, kind="exists") from error
        msg = f"{folder}: {error.strerror}; choose a folder you may write to"
        raise ExportError(msg) from error


def _plain(paint: ColorSpec) -> ColorSpec:
    """The paint as a recipe keeps it."""
    return ColorSpec(paint.name, paint.samples, observer=paint.observer)


def _digest(codes: Codes) -> str:
    return hashlib.sha256(sample_bytes(codes)).hexdigest()


def _warnings(
    paint: ColorSpec, pose: Pose, angles_deg: Sequence[float]
) -> Iterator[str]:
    missing = unsupported(survey(pose), angles_deg)
    if missing:
        yield (
            f"{pose.object} in this light shows too little of {_listed(missing)}: the "
            "fit can only extrapolate there; move the light, or paint on the sphere"
        )
    outside = beyond_srgb(paint, angles_deg)
    if outside:
        yield (
            f"the paint is beyond sRGB at {_listed(outside)}: the picture shows it "
            "paler, and a fit of the untouched picture would differ there"
        )


def _listed(angles_deg: Sequence[float]) -> str:
    return ", ".join(f"{angle:g}" for angle in angles_deg) + " degrees"
