"""What a violation of the schema means to the person who has to correct the file."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from lxml import etree

from paintlink.errors import SpecError
from paintlink.spec.schema import facets, field_type

_SHOWN = 80
_FIELD = re.compile(r"Element '(?:\{[^}]*\})?([^']*)'(?:, attribute '([^']*)')?:")
_MISSING_ATTRIBUTE = re.compile(r"The attribute '([^']*)' is required")
_NAMESPACE = re.compile(r"\{[^}]*\}")
_QUALIFIED_NAME = re.compile(r"\{[^}]*\}([\w.-]+)")

_PLAIN_NUMBER = (
    "must be a plain decimal number such as -12.5, without exponent, comma, NaN or INF"
)
RULES = {
    "angle": "must lie between {minInclusive} and {maxInclusive} degrees",
    "calibration": "must be one of {enumeration}",
    "chromaticity": "must lie between {minInclusive} and {maxInclusive}: check the "
    "units and the column order",
    "count": "must be a whole number, {minInclusive} or more",
    "finish": "must be one of {enumeration}",
    "glossAngle": "must be one of {enumeration} degrees, or left out",
    "glossUnits": "must lie between {minInclusive} and {maxInclusive} gloss units",
    "illuminant": "must be {enumeration}: convert the values first",
    "illumination": "must be {enumeration} degrees: this format holds no other light",
    "lightness": "must lie between {minInclusive} and {maxInclusive}: check the units "
    "and the column order",
    "nonNegativeNumber": "must be a finite number, {minInclusive} or more",
    "number": "must be a finite number",
    "observer": "must be one of {enumeration} degrees",
    "origin": "must be one of {enumeration}",
    "reflectanceFactor": "must lie between {minInclusive} and {maxInclusive}: factors "
    "are fractions, 1.0 = 100 %, so divide percentages by 100",
    "text": "must hold at most {maxLength} characters, none of them a control "
    "character other than tab and line break: shorten or clean it",
    "utcTime": "must be a time in UTC such as 2025-03-14T09:26:53.589793Z",
    "wavelength": "must lie between {minInclusive} and {maxInclusive} nm",
    "wavelengthStep": "must be above {minExclusive} and at most {maxInclusive} nm",
}
_XSI = "xsi:nil and xsi:type do not belong in a colour specification: remove them"
_STRUCTURE = {
    "SCHEMAV_CVC_COMPLEX_TYPE_2_1": "text does not belong here: remove it",
    "SCHEMAV_CVC_COMPLEX_TYPE_2_3": "text does not belong here: remove it",
    "SCHEMAV_CVC_COMPLEX_TYPE_3_2_1": "{attribute} does not belong here: remove it",
    "SCHEMAV_CVC_COMPLEX_TYPE_4": "the attribute {missing} is missing: add it",
    "SCHEMAV_CVC_ELT_3_1": _XSI,
    "SCHEMAV_CVC_ELT_4_1": _XSI,
    "SCHEMAV_CVC_ELT_4_2": _XSI,
    "SCHEMAV_CVC_ELT_4_3": _XSI,
    "SCHEMAV_CVC_TYPE_3_1_1": "{attribute} does not belong here: remove it",
    "SCHEMAV_CVC_TYPE_3_1_2": "only text may stand in here: remove the elements",
}


class _Place(NamedTuple):
    """Where a violation lies; ``node`` is None where it cannot be found again."""

    element: str
    attribute: str | None
    node: etree._Element | None


class _Finding(NamedTuple):
    """What is wrong, the element it is wrong with, and the value found there."""

    what: str
    element: str
    value: str | None = None


def shortened(text: str) -> str:
    """Text short enough for a message."""
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"


def legible(message: str) -> str:
    """Message of libxml2, which quotes the document, as one short printable line."""
    return shortened("".join(c if c.isprintable() else "?" for c in message))


def refusal(root: etree._Element, entry: etree._LogEntry) -> SpecError:
    """Error that says which field departs from the schema and what it must be."""
    finding = _finding(_place(root, entry), entry)
    return SpecError(
        finding.what,
        line=entry.line or None,
        element=shortened(finding.element),
        value=None if finding.value is None else shortened(finding.value),
    )


def _place(root: etree._Element, entry: etree._LogEntry) -> _Place:
    found = _FIELD.match(entry.message)
    element, attribute = found.groups() if found else ("", None)
    return _Place(element, attribute, _node(root, entry.path))


def _node(root: etree._Element, path: str | None) -> etree._Element | None:
    prefixes = {prefix: uri for prefix, uri in root.nsmap.items() if prefix}
    try:
        found: Any = root.getroottree().xpath(path or ".", namespaces=prefixes)
    except etree.XPathError:
        return None
    return found[0] if len(found) == 1 else None


def _finding(place: _Place, entry: etree._LogEntry) -> _Finding:
    kind, message = entry.type_name, entry.message
    if kind == "SCHEMAV_ELEMENT_CONTENT":
        return _wrong_children(place, message)
    if kind == "SCHEMAV_CVC_IDC":
        return _angle_twice(place)
    if kind in _STRUCTURE:
        return _wrong_structure(place, kind, message)
    type_name = field_type(place.element, place.attribute)
    if type_name in RULES:
        return _wrong_value(place, type_name)
    return _Finding(legible(_NAMESPACE.sub("", message)), place.element)


def _wrong_children(place: _Place, message: str) -> _Finding:
    """Finding for an element that is missing, unknown or out of order."""
    is_missing = message.partition(": ")[2].startswith("Missing")
    samples = _samples(place, is_missing)
    if samples is not None:
        what = "a colour specification needs Lab at 3, 5 or 6 aspecular angles"
        return _Finding(what, "samples", str(len(samples)))
    expected = " or ".join(_QUALIFIED_NAME.findall(message.partition("Expected")[2]))
    if is_missing:
        return _Finding(f"an element is missing: add {expected}", place.element)
    advice = f"expected here: {expected}" if expected else "remove it"
    return _Finding(f"this element does not belong here; {advice}", place.element)


def _samples(place: _Place, is_missing: bool) -> etree._Element | None:
    """Parent of the samples when their number is what is wrong."""
    if place.node is None:
        return None
    if is_missing:
        return place.node if place.element == "samples" else None
    parent = place.node.getparent()
    return parent if place.element == "sample" and _is_samples(parent) else None


def _is_samples(node: etree._Element | None) -> bool:
    return node is not None and etree.QName(node).localname == "samples"


def _angle_twice(place: _Place) -> _Finding:
    angle = None if place.node is None else place.node.get("aspecular")
    what = f"an aspecular angle stands twice: keep one {place.element}"
    return _Finding(what, place.element, angle)


def _wrong_structure(place: _Place, kind: str, message: str) -> _Finding:
    missing = _MISSING_ATTRIBUTE.search(message)
    what = _STRUCTURE[kind].format(
        attribute=_NAMESPACE.sub("", place.attribute or ""),
        missing=missing[1] if missing else "",
    )
    return _Finding(what, place.element, (_found(place) or "").strip() or None)


def _wrong_value(place: _Place, type_name: str) -> _Finding:
    value = _found(place)
    field = place.attribute or place.element
    return _Finding(f"{field} {_rule(type_name, value)}", place.element, value)


def _found(place: _Place) -> str | None:
    """What stands in the attribute, or in the element apart from its children."""
    if place.node is None:
        return None
    if place.attribute:
        return place.node.get(place.attribute, "")
    texts: Any = place.node.xpath("text()")
    return "".join(texts)


def _rule(type_name: str, value: str | None) -> str:
    limits = facets(type_name)
    number = facets("number")["pattern"]
    is_plain = value is None or re.fullmatch(number, value.strip(" \t\r\n"))
    if limits["primitive"] == "xs:double" and not is_plain:
        return _PLAIN_NUMBER
    return RULES[type_name].format_map(limits)
