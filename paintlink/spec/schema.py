"""The schema of format 1: where it lies, what it allows, what departs from it."""

from __future__ import annotations

import threading
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from lxml import etree

FORMAT = 1
NAMESPACE = f"urn:paintlink:color-specification:{FORMAT}"
ROOT = "colorSpecification"
_XS = {"xs": "http://www.w3.org/2001/XMLSchema"}

# An XMLSchema keeps the errors of its last run in itself, whoever ran it.
_LOCK = threading.Lock()


def schema_path() -> Path:
    """File of the schema, for other programs to validate with."""
    name = f"color-specification-{FORMAT}.xsd"
    return Path(str(resources.files("paintlink.spec") / name))


def first_violation(root: etree._Element) -> etree._LogEntry | None:
    """First place where a document departs from the schema, None when it does not."""
    with _LOCK:
        schema = _schema()
        if schema.validate(root):
            return None
        log: Any = schema.error_log
        first: etree._LogEntry = log[0]
        return first


def field_type(element: str, attribute: str | None = None) -> str:
    """Name of the type of a field, empty when the schema knows no such field."""
    if attribute is None:
        path = "//xs:element[@name=$element]"
    else:
        path = "//xs:complexType[@name=$element]/xs:attribute[@name=$attribute]"
    found = _document().xpath(
        f"string({path}/@type)",
        namespaces=_XS,
        element=element,
        attribute=attribute or "",
    )
    return str(found)


def facets(type_name: str) -> dict[str, str]:
    """Limits of a simple type, its own before those of its base.

    Keys are the names of the facets; ``primitive`` is the XML Schema type underneath.
    Empty for a complex type.
    """
    restriction = _document().find(
        f"xs:simpleType[@name='{type_name}']/xs:restriction", _XS
    )
    if restriction is None:
        return {}
    base = restriction.get("base", "")
    inherited = {"primitive": base} if base.startswith("xs:") else facets(base)
    choices = [
        node.get("value", "") for node in restriction.iterfind("xs:enumeration", _XS)
    ]
    own = {etree.QName(node).localname: node.get("value", "") for node in restriction}
    return inherited | own | ({"enumeration": ", ".join(choices)} if choices else {})


@cache
def _document() -> etree._Element:
    return etree.fromstring(schema_path().read_bytes())


@cache
def _schema() -> etree.XMLSchema:
    return etree.XMLSchema(_document())
