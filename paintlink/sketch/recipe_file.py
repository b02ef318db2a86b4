"""Recipes as JSON documents, read strictly."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from paintlink.errors import InputError, SpecError
from paintlink.model import ColorSpec, Lab, Observer, Sample
from paintlink.sketch.pose import Light, LightKind, Pose
from paintlink.sketch.recipe import Recipe

FORMAT = "paintlink-sketch"
VERSION = 1
MAX_BYTES = 1 << 18
THETA_SCALE_DEG = 180.0

_Number = Annotated[float, Field(allow_inf_nan=False)]
_Digest = Annotated[str, Field(pattern="^[0-9a-f]{64}$")]


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class _Light(_Part):
    kind: LightKind
    polar_deg: _Number
    azimuth_deg: _Number
    distance: _Number


class _Sample(_Part):
    aspecular_deg: _Number
    lab: Annotated[list[_Number], Field(min_length=3, max_length=3)]


class _Start(_Part):
    id: Annotated[str, Field(max_length=128)]
    name: Annotated[str, Field(max_length=1024)]
    observer: Observer
    samples: Annotated[list[_Sample], Field(max_length=16)]


class _Digests(_Part):
    start: _Digest
    geometry: _Digest


class _Document(_Part):
    format: Literal["paintlink-sketch"]
    version: Literal[1]
    object: str
    light: _Light
    size: int
    bits: int
    exposure: _Number
    theta_scale_deg: Literal[180]
    start: _Start
    sha256: _Digests


def write_recipe(recipe: Recipe) -> bytes:
    """The recipe as a JSON document; the same recipe always gives the same bytes."""
    document = {
        "format": FORMAT,
        "version": VERSION,
        "object": recipe.pose.object,
        "light": _light(recipe.pose.light),
        "size": recipe.pose.size,
        "bits": recipe.bits,
        "exposure": recipe.exposure,
        "theta_scale_deg": int(THETA_SCALE_DEG),
        "start": _start(recipe),
        "sha256": {"start": recipe.start_sha256, "geometry": recipe.geometry_sha256},
    }
    return (json.dumps(document, indent=2, ensure_ascii=False) + "\n").encode()


def read_recipe(data: bytes, source: str | None = None) -> Recipe:
    """Recipe in a JSON document.

    Raises
    ------
    SpecError
        When the bytes are anything but a recipe of version 1, naming the field.
    """
    table = _table(data, source)
    _require_version(table, source)
    try:
        return _recipe(_Document.model_validate(table))
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(map(str, first["loc"]))
        msg = f"{first['msg']}: set the sketch up again, or undo the change"
        raise SpecError(msg, source=source, element=place) from error
    except SpecError:
        raise
    except InputError as error:
        msg = f"{error}: set the sketch up again, or undo the change"
        raise SpecError(msg, source=source) from error


def read_recipe_file(path: Path) -> Recipe:
    """Recipe in a file; errors are those of `read_recipe`, naming the file."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        msg = f"cannot be read ({error.strerror}): name the recipe.json of the set-up"
        raise SpecError(msg, source=str(path)) from error
    return read_recipe(data, str(path))


def _table(data: bytes, source: str | None) -> dict[str, Any]:
    if len(data) > MAX_BYTES:
        msg = f"larger than {MAX_BYTES} bytes: this is no recipe of a sketch"
        raise SpecError(msg, source=source)
    try:
        table = json.loads(data)
    except (ValueError, RecursionError) as error:
        msg = f"not a JSON document ({error}): name the recipe.json of the set-up"
        raise SpecError(msg, source=source) from error
    if not isinstance(table, dict) or table.get("format") != FORMAT:
        msg = "not the recipe of a sketch: name the recipe.json of the set-up"
        raise SpecError(msg, source=source, element="format")
    return table


def _require_version(table: dict[str, Any], source: str | None) -> None:
    version = table.get("version")
    if isinstance(version, int) and version > VERSION:
        msg = (
            f"written by a newer paintlink (version {version}); "
            f"this one reads version {VERSION}: update paintlink"
        )
        raise SpecError(msg, source=source, element="version")


def _recipe(document: _Document) -> Recipe:
    start = document.start
    samples = tuple(
        Sample(one.aspecular_deg, Lab(one.lab[0], one.lab[1], one.lab[2]))
        for one in start.samples
    )
    light = document.light
    placed = Light(light.polar_deg, light.azimuth_deg, light.kind, light.distance)
    return Recipe(
        pose=Pose(document.object, placed, document.size),
        start=ColorSpec(start.name, samples, observer=start.observer),
        start_id=start.id,
        exposure=document.exposure,
        bits=document.bits,
        start_sha256=document.sha256.start,
        geometry_sha256=document.sha256.geometry,
    )


def _light(light: Light) -> dict[str, Any]:
    return {
        "kind": light.kind,
        "polar_deg": light.polar_deg,
        "azimuth_deg": light.azimuth_deg,
        "distance": light.distance,
    }


def _start(recipe: Recipe) -> dict[str, Any]:
    samples = [
        {"aspecular_deg": one.aspecular_deg, "lab": list(one.lab)}
        for one in recipe.start.samples
    ]
    return {
        "id": recipe.start_id,
        "name": recipe.start.name,
        "observer": recipe.start.observer,
        "samples": samples,
    }
