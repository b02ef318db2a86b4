from __future__ import annotations

from pathlib import Path

import pytest
from lxml import etree

from paintlink.errors import ConfigError, ExportError
from paintlink.export import load_format
from paintlink.export.stylesheet import (
    compile_stylesheet,
    parse_stylesheet,
    run_stylesheet,
)

SOURCE = Path("site/shop.xslt")
HEAD = (
    '<xsl:stylesheet version="1.0" xmlns:xsl="http://www.w3.org/1999/XSL/Transform" '
    'xmlns:exsl="http://exslt.org/common" xmlns:func="http://exslt.org/functions" '
    'xmlns:dyn="http://exslt.org/dynamic" xmlns:saxon="http://icl.com/saxon" {more}>'
)
CANARY = "the canary sings"


def sheet(body: str, *, top: str = "", more: str = "", doctype: str = "") -> bytes:
    """A stylesheet whose template stands on line 3."""
    lines = [
        doctype + HEAD.format(more=more),
        f'{top}<xsl:output method="xml"/>',
        f'<xsl:template match="/">{body}</xsl:template>',
        "</xsl:stylesheet>",
    ]
    return "\n".join(lines).encode()


def run(data: bytes, document: bytes = b"<a>text</a>", **parameters: str) -> bytes:
    transform = compile_stylesheet(parse_stylesheet(data, SOURCE), SOURCE)
    return run_stylesheet(transform, document, parameters, SOURCE)


@pytest.fixture
def canary(tmp_path: Path) -> Path:
    path = tmp_path / "canary.xml"
    path.write_text(f"<canary>{CANARY}</canary>")
    return path


def hostile(canary: Path, written: Path) -> dict[str, bytes]:
    """Every known way out of a stylesheet, by name."""
    value = '<xsl:value-of select="{}"/>'
    extension = 'extension-element-prefixes="exsl saxon"'
    return {
        "document": sheet(value.format(f"document('{canary}')")),
        "document with space": sheet(value.format(f"document ('{canary}')")),
        "document in test": sheet(f"<xsl:if test=\"document('{canary}')\">x</xsl:if>"),
        "document in template": sheet(f"<out a=\"{{document('{canary}')}}\"/>"),
        "document after quotes": sheet(
            f"<out a=\"it's {{concat('}}', document('{canary}'))}}\"/>"
        ),
        "document in key": sheet(
            "x", top=f"<xsl:key name=\"k\" match=\"a\" use=\"document('{canary}')\"/>"
        ),
        "document in parameter": sheet(
            "x", top=f"<xsl:param name=\"p\" select=\"document('{canary}')\"/>"
        ),
        "import": sheet("x", top=f'<xsl:import href="{canary}"/>'),
        "include": sheet("x", top=f'<xsl:include href="{canary}"/>'),
        "import over http": sheet("x", top='<xsl:import href="http://127.0.0.1:9/"/>'),
        "exsl:document": sheet(
            f'<exsl:document href="{written}">x</exsl:document>', more=extension
        ),
        "own extension prefix": sheet(
            f'<exsl:document href="{written}" xsl:extension-element-prefixes="exsl">x'
            "</exsl:document>"
        ),
        "saxon:output": sheet(
            f'<saxon:output href="{written}">x</saxon:output>', more=extension
        ),
        "xsl:document": sheet(f'<xsl:document href="{written}">x</xsl:document>'),
        "xsl:result-document": sheet(
            f'<xsl:result-document href="{written}">x</xsl:result-document>'
        ),
        "func:function": sheet(
            "x", top='<func:function name="func:f"><func:result/></func:function>'
        ),
        "dyn:evaluate": sheet(value.format("dyn:evaluate('document(1)')")),
        "unparsed-entity-uri": sheet(value.format("unparsed-entity-uri('e')")),
        "entity": sheet(
            "&leak;", doctype=f'<!DOCTYPE x [<!ENTITY leak SYSTEM "{canary}">]>'
        ),
        "empty DOCTYPE": sheet("x", doctype="<!DOCTYPE x>"),
        "version 2": sheet("x").replace(b'version="1.0"', b'version="2.0"'),
    }  # fmt: skip


@pytest.mark.parametrize("name", list(hostile(Path("c"), Path("w"))))
def test_stylesheet_that_reaches_out_is_refused(
    tmp_path: Path, canary: Path, name: str
) -> None:
    written = tmp_path / "written"
    data = hostile(canary, written)[name]

    with pytest.raises(ConfigError, match=r"shop\.xslt, line [123]: ") as caught:
        run(data)

    assert CANARY not in str(caught.value)
    assert not written.exists()


def test_runtime_denies_what_the_check_would_miss(canary: Path) -> None:
    transform = compile_stylesheet(_unchecked(f"document('{canary}')"), SOURCE)

    with pytest.raises(ExportError, match="denied") as caught:
        run_stylesheet(transform, b"<a/>", {}, SOURCE)

    assert CANARY not in str(caught.value)


def _unchecked(expression: str):
    return etree.fromstring(sheet(f'<xsl:value-of select="{expression}"/>'))


def test_refusal_names_call_attribute_and_line() -> None:
    data = sheet("<xsl:value-of\n select=\"concat('a', document('b'))\"/>")

    with pytest.raises(ConfigError, match=r"line 4: document\(\) in select is not al"):
        parse_stylesheet(data, SOURCE)


@pytest.mark.parametrize(
    "body",
    [
        "<out title=\"see document('x')\"/>",
        "<out title=\"{{document('x')}}\"/>",
        "<xsl:value-of select=\"concat('document(', ')')\"/>",
        '<xsl:for-each select="*[position() = last() and (1 or (0))]">x</xsl:for-each>',
        '<xsl:value-of select="child::text()"/>',
        "<xsl:comment>document('x')</xsl:comment>",
        '<custom xmlns="urn:customer"><inner/></custom>',
    ],
)
def test_harmless_stylesheet_is_taken(body: str) -> None:
    parse_stylesheet(sheet(body), SOURCE)


def test_endless_recursion_is_stopped() -> None:
    top = '<xsl:template name="again"><a><xsl:call-template name="again"/></a>'
    data = sheet('<xsl:call-template name="again"/>', top=f"{top}</xsl:template>")

    with pytest.raises(ExportError, match="infinite template recursion") as caught:
        run(data)

    assert caught.value.kind == "format"


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ('<xsl:value-of select="1 +"/>', r"line 3: not a working stylesheet .*'1 \+'"),
        ("<xsl:value-of/>", "line 3: not a working stylesheet .*select is missing"),
        ("<xsl:value-of", r"line 3: not well-formed XML \([^,]*\); correct"),
    ],
)
def test_broken_stylesheet_is_reported_with_its_line(body: str, what: str) -> None:
    with pytest.raises(ConfigError, match=rf"shop\.xslt, {what}"):
        run(sheet(body))


def test_failure_while_running_names_the_line() -> None:
    data = sheet('<xsl:call-template name="absent"/>')

    with pytest.raises(ExportError, match=r"shop\.xslt, line 3: .*absent.* not found"):
        run(data)


def test_stylesheet_may_refuse_with_its_own_words() -> None:
    data = sheet('<xsl:message terminate="yes">no gloss measured</xsl:message>')

    with pytest.raises(ExportError, match=r"shop\.xslt: no gloss measured; correct"):
        run(data)


def test_empty_output_is_an_error() -> None:
    data = sheet("").replace(b'method="xml"', b'method="text"')

    with pytest.raises(ExportError, match="wrote nothing"):
        run(data)


def test_huge_stylesheet_is_refused() -> None:
    with pytest.raises(ConfigError, match="larger than 1 MiB"):
        parse_stylesheet(sheet("x" * (1 << 20)), SOURCE)


def test_output_follows_the_declared_encoding() -> None:
    data = sheet("é and Ω").replace(
        b'method="xml"', b'method="text" encoding="windows-1252"'
    )

    assert run(data) == b"\xe9 and &#937;"


def test_parameters_arrive_as_text_whatever_they_hold() -> None:
    text = "'\"]]> concat('a', 'b') <x/> &amp;"
    data = sheet('<xsl:value-of select="$text"/>', top='<xsl:param name="text"/>')
    data = data.replace(b'method="xml"', b'method="text"')

    assert run(data, text=text).decode() == text


def test_unreadable_stylesheet_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "shop.xslt"
    path.mkdir()

    with pytest.raises(ConfigError, match=r"cannot be read \(Is a directory"):
        load_format(path)
