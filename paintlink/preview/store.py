"""Baked tables: kept in memory and, where a folder is given, on disk."""

from __future__ import annotations

import hashlib
import io
import logging
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import numpy as np

from paintlink.preview import bake, coat
from paintlink.preview.arrays import Float32Array
from paintlink.preview.environment import Environment
from paintlink.preview.mesh import Mesh
from paintlink.preview.occlusion import FLOOR_CELLS, Occlusion, occlusion
from paintlink.preview.view import FRONT, View

RECIPE = 4
"""To be raised whenever a table would come out differently from the same light."""

SUFFIX = ".plbasis"
MAGIC = b"plbasis\n"
DIGEST_BYTES = hashlib.sha256().digest_size

_log = logging.getLogger(__name__)


@lru_cache(maxsize=24)
def base_table(
    light: Environment,
    folder: Path | None,
    view: View = FRONT,
    *,
    coarse: bool = False,
) -> Float32Array:
    """Table of `bake.base_table` for the light, baked at most once."""
    recipe = f"base {view} {coarse} {light.digest}"
    return _kept(recipe, folder, lambda: bake.base_table(light, view, coarse=coarse))


@lru_cache(maxsize=24)
def coat_table(
    light: Environment, roughness: float, folder: Path | None, view: View = FRONT
) -> Float32Array:
    """Table of `coat.coat_table` for the light, baked at most once."""
    recipe = f"coat {roughness} {view} {light.digest}"
    return _kept(recipe, folder, lambda: coat.coat_table(light, roughness, view))


@lru_cache(maxsize=8)
def shade(mesh: Mesh, folder: Path | None) -> Occlusion:
    """Occlusion of a mesh, found out at most once."""
    table = _kept(f"shade {mesh.digest}", folder, lambda: _packed(occlusion(mesh)))
    floor = FLOOR_CELLS**2
    return Occlusion(
        table[floor:].reshape(-1, 2), table[:floor].reshape(FLOOR_CELLS, FLOOR_CELLS)
    )


def _packed(shade: Occlusion) -> Float32Array:
    return np.concatenate([shade.floor.ravel(), shade.vertices.ravel()])


def _kept(
    recipe: str, folder: Path | None, build: Callable[[], Float32Array]
) -> Float32Array:
    """The table from its file; else built, and written for the next time."""
    if folder is None:
        return build()
    digest = hashlib.sha256(f"{RECIPE} {recipe}".encode()).hexdigest()
    path = folder / f"{recipe.split()[0]}-{digest[:24]}{SUFFIX}"
    table = _read(path)
    if table is None:
        table = build()
        _write(path, table)
    return table


def _read(path: Path) -> Float32Array | None:
    """The table, or None when the file is missing, cut short or damaged."""
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        _log.warning("preview cache: cannot read %s (%s), baking again", path, error)
        return None
    payload = content[len(MAGIC) + DIGEST_BYTES :]
    if content != _sealed(payload):
        _log.warning("preview cache: %s is damaged, baking again", path)
        return None
    table: Float32Array = np.load(io.BytesIO(payload), allow_pickle=False)
    return table


def _write(path: Path, table: Float32Array) -> None:
    """Put the whole file in place at once; a cache that cannot be kept is no error."""
    payload = io.BytesIO()
    np.save(payload, table, allow_pickle=False)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            file.write(_sealed(payload.getvalue()))
        Path(file.name).replace(path)
    except OSError as error:
        _log.warning("preview cache: cannot write %s (%s)", path, error)


def _sealed(payload: bytes) -> bytes:
    return MAGIC + hashlib.sha256(payload).digest() + payload
