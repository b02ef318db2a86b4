"""The object in the picture: a relief, a mesh of ours, or a file of the user's."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Protocol, cast

from paintlink.preview import objects, relief
from paintlink.preview.names import find
from paintlink.preview.surface import Surface


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

    def __hash__(self) -> int: ...

    def surface(self, size: int, rows: slice) -> Surface:
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

    def surface(self, size: int, rows: slice) -> Surface:
        """What is seen in some rows."""
        return relief.surface(load_shape(self.name), size, rows)


def load_shape(name: str) -> relief.Shape:
    """The relief ``name``; errors are those of `names.require`."""
    return cast(relief.Shape, import_module(find(name, objects, "object")))


def form(name: str) -> Form:
    """The object of a name."""
    load_shape(name)
    return ReliefForm(name)
