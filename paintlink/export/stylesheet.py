"""Stylesheets: parsed without trust, compiled, run without access to anything."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from lxml import etree

from paintlink.errors import ConfigError, ExportError
from paintlink.export.refusals import refusals

MAX_BYTES = 1 << 20

_LINE_AND_COLUMN = re.compile(r", line \d+, column \d+$")

# The stubs of lxml know neither DENY_ALL nor the parameters of a stylesheet.
_access: Any = etree.XSLTAccessControl
_PARSER = etree.XMLParser(
    resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False
)


def stylesheet_error(source: Path, line: int | None, what: str) -> ConfigError:
    """The error that names the file and the line of a faulty stylesheet."""
    return ConfigError(f"{_place(source, line)}: {what}")


def parse_stylesheet(data: bytes, source: Path) -> etree._Element:
    """Root of a stylesheet that reads nothing but its input and writes only output.

    Raises
    ------
    ConfigError
        For anything that is not XSLT 1.0, and for every way to reach a file, the
        network or the processor's extensions.
    """
    if len(data) > MAX_BYTES:
        msg = "larger than 1 MiB; a stylesheet is a few kilobytes"
        raise stylesheet_error(source, None, msg)
    try:
        root = etree.fromstring(data, _PARSER)
    except etree.XMLSyntaxError as error:
        cause = _LINE_AND_COLUMN.sub("", error.msg or "no XML in it")
        msg = f"not well-formed XML ({cause}); correct the stylesheet"
        raise stylesheet_error(source, error.lineno, msg) from error
    refused = next(refusals(root), None)
    if refused:
        raise stylesheet_error(source, *refused)
    return root


def compile_stylesheet(root: etree._Element, source: Path) -> etree.XSLT:
    """The stylesheet ready to run; it may not open anything while it does."""
    try:
        return etree.XSLT(root, access_control=_access.DENY_ALL, regexp=False)
    except etree.XSLTParseError as error:
        line, what = _fault(error)
        msg = f"not a working stylesheet ({what}); correct it"
        raise stylesheet_error(source, line, msg) from error


def run_stylesheet(
    transform: etree.XSLT, document: bytes, parameters: dict[str, str], source: Path
) -> bytes:
    """What the stylesheet makes of a document, in the encoding it declares.

    Raises
    ------
    ExportError
        When it fails on this document, recurses without end, or writes nothing.
    """
    run: Any = transform
    quoted = {name: etree.XSLT.strparam(text) for name, text in parameters.items()}
    try:
        data = bytes(run(etree.fromstring(document, _PARSER), **quoted))
    except etree.XSLTApplyError as error:
        line, what = _fault(error)
        msg = f"{_place(source, line)}: {what}; correct the stylesheet"
        raise ExportError(msg, kind="format") from error
    if not data:
        msg = f"{source}: wrote nothing; correct the stylesheet"
        raise ExportError(msg, kind="format")
    return data


def _place(source: Path, line: int | None) -> str:
    return f"{source}, line {line}" if line else str(source)


def _fault(error: etree.XSLTError) -> tuple[int | None, str]:
    """Line and cause of what libxslt complains about."""
    entries = list(error.error_log)
    lines = [entry.line for entry in entries if entry.line > 0]
    causes = [entry.message for entry in entries if entry.message != "unknown error"]
    cause = (causes or [str(error)])[-1]
    return (lines or [None])[-1], cause.splitlines()[0]
