"""What a stylesheet may not do: everything beyond its input and its output."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import cast

from lxml import etree

XSLT = "http://www.w3.org/1999/XSL/Transform"
METADATA = "urn:paintlink:export-format:1"

# XSLT 1.0 without import and include; libxslt also knows elements that write files.
_ELEMENTS = """
apply-imports apply-templates attribute attribute-set call-template choose comment copy
copy-of decimal-format element fallback for-each if key message namespace-alias number
otherwise output param preserve-space processing-instruction sort strip-space stylesheet
template text transform value-of variable when with-param
"""
# XPath 1.0 and XSLT 1.0 without document() and unparsed-entity-uri(); the operators
# and node tests may stand before a parenthesis as well.
_FUNCTIONS = """
last position count id local-name namespace-uri name string concat starts-with contains
substring-before substring-after substring string-length normalize-space translate
boolean not true false lang number sum floor ceiling round key format-number current
generate-id system-property element-available function-available comment text
processing-instruction node and or div mod
"""
ELEMENTS = frozenset(_ELEMENTS.split())
FUNCTIONS = frozenset(_FUNCTIONS.split())
EXPRESSIONS = frozenset({"select", "test", "match", "use", "count", "from", "value"})

_LITERAL = re.compile(r"'[^']*'|\"[^\"]*\"")
_CALL = re.compile(r"([\w.-]+(?::[\w.-]+)?)\s*\(")
# An attribute value template: "{{" is a brace, anything else in braces an expression.
_TEMPLATE = re.compile(r"\{\{|\{((?:[^'\"{}]|'[^']*'|\"[^\"]*\")*)\}")


def refusals(root: etree._Element) -> Iterator[tuple[int | None, str]]:
    """Line and reason of everything that XSLT 1.0 on one document does not need."""
    name = etree.QName(root)
    if root.getroottree().docinfo.internalDTD is not None:
        yield 1, "a document type definition (DOCTYPE) is never accepted; remove it"
    if name.namespace != XSLT or name.localname not in {"stylesheet", "transform"}:
        yield line_of(root), f"<{name.localname}> is not a stylesheet; write XSLT 1.0"
    if root.get("version") != "1.0":
        yield line_of(root), 'version must be "1.0"; write the stylesheet in XSLT 1.0'
    for element in root.iter("*"):
        for what in _forbidden_element(element, root):
            yield line_of(element), what
        for what in _forbidden_attributes(element):
            yield line_of(element), what


def line_of(element: etree._Element) -> int | None:
    """Line of an element in its file, counted from 1."""
    return cast("int | None", element.sourceline)


def _forbidden_element(element: etree._Element, root: etree._Element) -> Iterator[str]:
    name = etree.QName(element)
    if name.namespace == XSLT:
        if name.localname not in ELEMENTS:
            yield f"xsl:{name.localname} is not allowed; keep all in this one file"
    elif element.getparent() is root and name.namespace != METADATA:
        yield f"<{name.localname}> at the top is an extension; remove it"


def _forbidden_attributes(element: etree._Element) -> Iterator[str]:
    in_xslt = etree.QName(element).namespace == XSLT
    for attribute, value in element.attrib.items():
        name = etree.QName(attribute).localname
        if name == "extension-element-prefixes":
            yield f"{name} is not allowed; use the elements of XSLT 1.0 only"
        is_expression = in_xslt and attribute in EXPRESSIONS
        for call in _calls([str(value)] if is_expression else _templates(str(value))):
            yield f"{call}() in {name} is not allowed; use XPath 1.0 functions only"


def _templates(value: str) -> list[str]:
    return [found[1] for found in _TEMPLATE.finditer(value) if found[1]]


def _calls(expressions: list[str]) -> Iterator[str]:
    for expression in expressions:
        bare = _LITERAL.sub("''", expression)
        for found in _CALL.finditer(bare):
            if found[1] not in FUNCTIONS:
                yield found[1]
