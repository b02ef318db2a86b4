"""The object in the picture: a relief, a mesh of ours, or a file of the user's."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Protocol, cast

from paintlink.errors import PreviewError
from paintlink.preview import camera, mesh_file, mesh_surface, objects, relief, store
from paintlink.preview.camera import Camera
from paintlink.preview.mesh import Mesh
from paintlink.preview.names import find
from paintlink.preview.relief_mesh import relief_mesh
from paintlink.preview.surface import Surface
from paintlink.preview.view import FRONT, View


class Form(Protocol):
    """What can be looked at; equal forms give equal pictures."""

    @property
    def name(self) -> str:
        """Name of the object, or of its file."""
        ...

    @property
    def label(self) -> str:
        """Name for people."""
        ...

    @property
    def span(self) -> tuple[float, float]:
        """Left and right end in the picture, -1 to 1."""
        ...

    @property
    def view(self) -> View:
        """From where the middle of the picture is seen."""
        ...

    def __hash__(self) -> int: ...

    def surface(self, size: int, rows: slice, cache_dir: Path | None) -> Surface:
        """What the camera sees in some rows of a picture of ``size`` pixels."""
        ...


@dataclass(frozen=True)
class ReliefForm:
    """An object seen straight from the front."""

    name: str

    @property
    def label(self) -> str:
        """Name for people."""
        return load_shape(self.name).LABEL

    @property
    def span(self) -> tuple[float, float]:
        """Left and right end in the picture, -1 to 1."""
        return load_shape(self.name).SPAN

    @property
    def view(self) -> View:
        """Straight from the front."""
        return FRONT

    def surface(self, size: int, rows: slice, cache_dir: Path | None) -> Surface:
        """What is seen in some rows."""
        del cache_dir
        return relief.surface(load_shape(self.name), size, rows)


@dataclass(frozen=True)
class MeshForm:
    """Triangles seen by a camera."""

    name: str
    label: str
    mesh: Mesh
    camera: Camera

    @property
    def span(self) -> tuple[float, float]:
        """Left and right end in the picture, -1 to 1."""
        return camera.span(self.mesh, self.camera)

    @property
    def view(self) -> View:
        """From where the middle of the picture is seen."""
        return self.camera.view

    def surface(self, size: int, rows: slice, cache_dir: Path | None) -> Surface:
        """What is seen in some rows."""
        shade = store.shade(self.mesh, cache_dir)
        return mesh_surface.surface(self.mesh, shade, self.camera, size=size, rows=rows)


def load_shape(name: str) -> relief.Shape:
    """The relief ``name``; errors are those of `names.require`."""
    return cast(relief.Shape, import_module(find(name, objects, "object")))


def form(name: str, *, turn_deg: float = 0.0, perspective: bool = False) -> Form:
    """The object of a name, or the mesh in a file.

    Raises
    ------
    PreviewError
        When there is no such object, or when a relief is to be turned.
    """
    if Path(name).suffix.lower() in mesh_file.SUFFIXES:
        path = Path(name)
        seen = Camera(turn_deg=turn_deg, perspective=perspective)
        return MeshForm(path.name, path.stem, mesh_file.load(path), seen)
    module = import_module(find(name, objects, "object"))
    if hasattr(module, "mesh"):
        seen = Camera(turn_deg=turn_deg, perspective=perspective)
        return MeshForm(name, module.LABEL, module.mesh(), seen)
    if turn_deg:
        msg = f"the {name} has no back and cannot be turned: take the car or a mesh"
        raise PreviewError(msg)
    if perspective:
        seen = Camera(perspective=True)
        return MeshForm(name, module.LABEL, relief_mesh(name), seen)
    return ReliefForm(name)
