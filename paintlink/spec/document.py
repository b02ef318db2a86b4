"""From bytes of unknown origin to a document that keeps to the schema."""

from __future__ import annotations

import codecs
import re
from typing import cast

from lxml import etree

from paintlink.errors import SpecError
from paintlink.spec.schema import FORMAT, NAMESPACE, ROOT, first_violation
from paintlink.spec.violations import legible, refusal, shortened

MAX_BYTES = 1 << 20
# Room for everything the schema allows at once. Finding the place of a violation costs
# libxml2 time in proportion to its siblings, so a crowd of faults would cost seconds.
MAX_NODES = 8_000

_ENCODING = re.compile(r"\s*<\?xml\s[^>]*?encoding\s*=\s*[\"']([^\"']*)")
_OTHER_FORMAT = re.compile(r"urn:paintlink:color-specification:([0-9]{1,9})")
_COUNT_NODES = etree.XPath("count(//*) + count(//@*)")
_LINE_AND_COLUMN = re.compile(r", line \d+, column \d+$")

_PARSER = etree.XMLParser(
    encoding="utf-8",
    resolve_entities=False,
    no_network=True,
    load_dtd=False,
    dtd_validation=False,
    attribute_defaults=False,
    huge_tree=False,
    remove_comments=True,
    remove_pis=True,
)


def valid_root(data: bytes) -> etree._Element:
    """Root of the document in ``data``, which satisfies the schema.

    Reads nothing but ``data``: no entity, schema or inclusion it names is ever opened.

    Raises
    ------
    SpecError
        When the bytes are anything but a colour specification of format 1.
    """
    root = safe_root(data)
    _require_format(root)
    _require_few_nodes(root)
    violation = first_violation(root)
    if violation is not None:
        raise refusal(root, violation)
    return root


def safe_root(data: bytes) -> etree._Element:
    """Root of a small XML document without type declaration, whatever its schema.

    Raises
    ------
    SpecError
        When the bytes are too many, or no such document.
    """
    require_small(len(data))
    return safe_root_of_text(decoded(data))


def safe_root_of_text(text: str) -> etree._Element:
    """Root of an XML document of any size without type declaration.

    Raises
    ------
    SpecError
        When it has one, or is not well formed.
    """
    before, doctype, _ = text.partition("<!DOCTYPE")
    if doctype:
        raise _doctype_error(before.count("\n") + 1)
    return parsed(text)


def line_of(node: etree._Element) -> int | None:
    """Line of the document an element starts in, 1-based."""
    return cast("int | None", node.sourceline)


def require_small(size: int, source: str | None = None) -> None:
    """Refuse a document of more than 1 MiB, given its size in bytes."""
    if size > MAX_BYTES:
        msg = f"larger than {MAX_BYTES} bytes: no document about a colour needs as many"
        raise SpecError(msg, source=source, value=f"{size} bytes")


def decoded(data: bytes) -> str:
    """Text of a document that says truly in which encoding it is."""
    if not data.strip():
        msg = "the file is empty: write it again"
        raise SpecError(msg)
    is_utf16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    encoding = "UTF-16" if is_utf16 else "UTF-8"
    try:
        text = data.decode("utf-16" if is_utf16 else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        msg = f"byte {error.start + 1} is not {encoding}: save the file as UTF-8"
        raise SpecError(msg, line=line) from error
    _require_declared(text, encoding)
    return text


def _require_declared(text: str, encoding: str) -> None:
    """Refuse an encoding declaration that other programs would decode differently."""
    found = _ENCODING.match(text)
    if found and found[1].upper() != encoding:
        msg = f"declares another encoding than its bytes are in: save it as {encoding}"
        raise SpecError(msg, line=1, value=shortened(found[1]))


def _doctype_error(line: int | None = None) -> SpecError:
    msg = "a document type definition (DOCTYPE) is never accepted: remove it"
    return SpecError(msg, line=line, element="!DOCTYPE")


def parsed(text: str) -> etree._Element:
    """Root of a document without type declaration; opens nothing, whatever it is."""
    try:
        root = etree.fromstring(text.encode(), _PARSER)
    except etree.XMLSyntaxError as error:
        cause = _LINE_AND_COLUMN.sub("", error.msg or "no XML in it")
        msg = f"not well-formed XML ({legible(cause)}): write the file again"
        raise SpecError(msg, line=error.lineno or None) from error
    if root.getroottree().docinfo.internalDTD is not None:
        raise _doctype_error()
    return root


def _require_format(root: etree._Element) -> None:
    name = etree.QName(root)
    if (name.namespace, name.localname) == (NAMESPACE, ROOT):
        return
    other = _OTHER_FORMAT.fullmatch(name.namespace or "")
    if other and int(other[1]) > FORMAT:
        msg = (
            f"written by a newer paintlink (format {int(other[1])}); "
            f"this one reads format {FORMAT}: update paintlink"
        )
    else:
        msg = f'not a colour specification: expected <{ROOT} xmlns="{NAMESPACE}">'
    raise SpecError(
        msg,
        line=line_of(root),
        element=shortened(name.localname),
        value=shortened(name.namespace or "no namespace"),
    )


def _require_few_nodes(root: etree._Element) -> None:
    nodes = int(cast("float", _COUNT_NODES(root)))
    if nodes > MAX_NODES:
        msg = f"more than {MAX_NODES} elements and attributes: no colour needs as many"
        raise SpecError(msg, value=str(nodes))
