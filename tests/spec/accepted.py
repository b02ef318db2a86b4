"""Documents that look unlike the canonical form and say the same."""

from __future__ import annotations

from tests.spec.corpus import BODY, CANARY, COMPLETE, PORT, Case, edited

_HTTP = f"http://127.0.0.1:{PORT}/evil"
_XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
_ROWS = [line for line in COMPLETE.splitlines(keepends=True) if "<sample " in line]


def _prefixed() -> str:
    text = COMPLETE.replace("</", "\0").replace("<", "<p:").replace("\0", "</p:")
    return text.replace("<p:?", "<?").replace(" xmlns=", " xmlns:p=")


ENCODED = [
    Case("UTF-16", edited("UTF-8", "UTF-16"), encoding="utf-16"),
    Case("UTF-16 in small letters", edited("UTF-8", "utf-16"), encoding="utf-16"),
    Case("UTF-16 without declaration", BODY, encoding="utf-16"),
    Case("UTF-16, high byte first", f"\ufeff{BODY}", encoding="utf-16-be"),
    Case("byte-order mark of Windows", COMPLETE, encoding="utf-8-sig"),
    Case("no declaration", BODY),
    Case("no encoding declared", edited(' encoding="UTF-8"', "")),
    Case("standalone", edited('"UTF-8"', "'utf-8' standalone='yes'")),
    Case("line ends of Windows", COMPLETE.replace("\n", "\r\n")),
    Case("line ends of old Macs", COMPLETE.replace("\n", "\r")),
    Case("all in one line", "".join(map(str.strip, COMPLETE.splitlines()))),
]

SPELLED = [
    Case("prefix", _prefixed()),
    Case("samples reversed", edited("".join(_ROWS), "".join(reversed(_ROWS)))),
    Case("trailing zeros", edited('L="60.1"', 'L="060.100"')),
    Case("angle with a decimal", edited('angle="60"', 'angle="60.0"')),
    Case("white space around a number", edited('L="60.1"', 'L=" 60.1\t"')),
    Case("point without digits before", edited('a="-0.98"', 'a="-.98"')),
    Case("point without digits after", edited('L="31"', 'L="31."')),
    Case("zero with a minus", edited('dH="0"', 'dH="-0"')),
    Case("more digits than a double", edited('L="60.1"', f'L="60.1{"0" * 300}1"')),
    Case("white space around a time", edited("<time>", "<time>\n  ")),
    Case("character references", edited("Quartz", "&#81;u&#x61;rtz")),
    Case("quoted text", edited("Quartz Silver", "<![CDATA[Quartz]]> Silver")),
    Case("comment inside a text", edited("Quartz", "Qua<!-- zz -->rtz")),
    Case("instruction inside a text", edited("Quartz", "Qua<?zz zz?>rtz")),
]

HARMLESS = [
    Case(
        "stylesheet instruction",
        edited(
            "<colorSpec",
            f'<?xml-stylesheet type="text/xsl" href="{_HTTP}"?>\n<colorSpec',
        ),
    ),
    Case(
        "schema on a server",
        edited("<name>", f'<name {_XSI} xsi:schemaLocation="urn:x {_HTTP}">'),
    ),
    Case(
        "schema of this format on a server",
        edited(
            ':1">',
            f':1" {_XSI} xsi:schemaLocation="'
            f'urn:paintlink:color-specification:1 {_HTTP}">',
        ),
    ),
    Case(
        "schema in a file",
        edited("<name>", f'<name {_XSI} xsi:noNamespaceSchemaLocation="{CANARY}">'),
    ),
    Case(
        "inclusion in a comment", edited("<gloss", f"<!-- {CANARY} {_HTTP} --><gloss")
    ),
    Case("catalogue instruction", f'<?oasis-xml-catalog catalog="{_HTTP}"?>{BODY}'),
    Case("foreign name space", edited("<gloss", f'<gloss xmlns:x="{_HTTP}"')),
]

ACCEPTED = ENCODED + SPELLED + HARMLESS
