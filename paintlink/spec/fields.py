"""A typed view of one element whose fields the schema has checked."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lxml import etree

from paintlink.spec.schema import NAMESPACE


@dataclass(frozen=True, slots=True)
class Fields:
    """Fields of an element of a colour specification, by name."""

    node: etree._Element

    def word(self, attribute: str) -> str:
        """Attribute as it stands, empty when left out."""
        return self.node.get(attribute, "")

    def number(self, attribute: str) -> float:
        """Number in a required attribute."""
        return float(self.word(attribute))

    def optional_number(self, attribute: str) -> float | None:
        """Number in an attribute, None when left out."""
        return self.number(attribute) if self.word(attribute) else None

    def text(self, element: str, default: str = "") -> str:
        """Text of a child exactly as written, ``default`` when left out."""
        child = self.child(element)
        return default if child is None else child.node.text or ""

    def numbers(self) -> tuple[float, ...]:
        """Numbers in the children, in their order."""
        return tuple(float(child.text or "") for child in self.node)

    def child(self, element: str) -> Fields | None:
        """First child of this name."""
        node = self.node.find(f"{{{NAMESPACE}}}{element}")
        return None if node is None else Fields(node)

    def children(self, element: str) -> Iterator[Fields]:
        """Every child of this name, in the order of the document."""
        return map(Fields, self.node.iterfind(f"{{{NAMESPACE}}}{element}"))
