"""Meshes of the user: OBJ, GLB, PLY and STL files."""

from __future__ import annotations

import logging
from functools import lru_cache
from pathlib import Path

import numpy as np

from paintlink.errors import PreviewError
from paintlink.preview.mesh import Mesh, checked

SUFFIXES = (".obj", ".glb", ".gltf", ".ply", ".stl")
MOST_BYTES = 256 << 20


def load(path: Path) -> Mesh:
    """The mesh of a file; read again when the file changed.

    Raises
    ------
    PreviewError
        When the file cannot be read, is too large, or holds nothing to draw.
    """
    try:
        state = path.stat()
    except OSError as error:
        msg = f"cannot read the object {path}: {error.strerror}"
        raise PreviewError(msg) from error
    if state.st_size > MOST_BYTES:
        msg = f"{path} has {state.st_size >> 20} MiB, more than {MOST_BYTES >> 20}"
        raise PreviewError(msg)
    return _load(path, state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=4)
def _load(path: Path, _changed_ns: int, _size: int) -> Mesh:
    try:
        import trimesh
    except ImportError as error:
        msg = f"{path}: to draw meshes, install paintlink with its extra: [meshes]"
        raise PreviewError(msg) from error
    logging.getLogger("trimesh").setLevel(logging.ERROR)
    try:
        loaded = trimesh.load_mesh(path, process=True)
        vertices, faces = loaded.vertices, loaded.faces
    except Exception as error:
        said = str(error) or type(error).__name__
        msg = f"{path} is no mesh that can be read ({said}): export it again"
        raise PreviewError(msg) from error
    return checked(np.array(vertices, np.float64), np.array(faces, np.intp), str(path))
