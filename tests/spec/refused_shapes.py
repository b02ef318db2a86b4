"""Documents that are cut off, misspelt, or meant for another program."""

from __future__ import annotations

from tests.spec.corpus import BODY, COMPLETE, DECLARATION, Case, edited, line_of, wrong

FORMAT_1 = "urn:paintlink:color-specification:1"
_SAMPLE_110 = '    <sample aspecular="110" L="31" a="-0.98" b="-2"/>\n'
_XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
_XML = "not well-formed XML"


def _with_samples(count: int) -> str:
    start = COMPLETE.index("    <sample ")
    end = COMPLETE.index("  </samples>")
    rows = [f'    <sample aspecular="{n}" L="1" a="0" b="0"/>\n' for n in range(count)]
    return COMPLETE[:start] + "".join(rows) + COMPLETE[end:]


def _counted(count: int, line: int) -> Case:
    return Case(
        f"{count} samples",
        _with_samples(count),
        "a colour specification needs Lab at 3, 5 or 6 aspecular angles",
        line,
        "samples",
        str(count),
    )


def _root(name: str, namespace: str, words: str, value: str) -> Case:
    text = COMPLETE.replace(f' xmlns="{FORMAT_1}"', namespace)
    return Case(name, text, words, 2, "colorSpecification", value)


SAMPLES = [_counted(count, 6) for count in (0, 1, 2, 4)] + [_counted(7, 13)]

ROOTS = [
    _root(
        "future format",
        ' xmlns="urn:paintlink:color-specification:2"',
        r"written by a newer paintlink \(format 2\); "
        "this one reads format 1: update paintlink",
        "urn:paintlink:color-specification:2",
    ),
    _root(
        "far future format",
        ' xmlns="urn:paintlink:color-specification:417"',
        r"written by a newer paintlink \(format 417\)",
        "urn:paintlink:color-specification:417",
    ),
    _root(
        "format 0",
        ' xmlns="urn:paintlink:color-specification:0"',
        "not a colour specification: expected <colorSpecification xmlns=",
        "urn:paintlink:color-specification:0",
    ),
    _root("no namespace", "", "not a colour specification", "no namespace"),
    _root(
        "namespace of another program",
        ' xmlns="http://colorexchangeformat.com/CxF3-core"',
        "not a colour specification",
        "http://colorexchangeformat.com/CxF3-core",
    ),
    Case(
        "wrong root",
        COMPLETE.replace("colorSpecification", "colourSpecification"),
        f'expected <colorSpecification xmlns="{FORMAT_1}">',
        2,
        "colourSpecification",
        FORMAT_1,
    ),
    Case(
        "a part in place of the whole",
        f'<samples xmlns="{FORMAT_1}"/>',
        "not a colour specification",
        1,
        "samples",
        FORMAT_1,
    ),
    Case(
        "web page in place of a file",
        "<html><body>404</body></html>",
        "not a colour specification",
        1,
        "html",
        "no namespace",
    ),
]

ELEMENTS = [
    Case(
        "finish left out",
        edited("  <finish>metallic</finish>\n", ""),
        "this element does not belong here; expected here: finish",
        5,
        "samples",
    ),
    Case(
        "finish after the samples",
        edited("  </samples>\n", "  </samples>\n  <finish>solid</finish>\n"),
        "this element does not belong here; expected here: gloss or spectra",
        11,
        "finish",
    ),
    Case(
        "samples left out",
        COMPLETE[: COMPLETE.index("  <samples")] + "</colorSpecification>",
        "an element is missing: add samples",
        2,
        "colorSpecification",
    ),
    Case(
        "one factor only",
        edited("      <factor>0.2813</factor>\n", ""),
        "an element is missing: add factor",
        line_of('    <spectrum aspecular="45"'),
        "spectrum",
    ),
    Case(
        "unknown element",
        edited("  <gloss", "  <haze/>\n  <gloss"),
        "this element does not belong here; expected here: gloss or",
        line_of("  <gloss"),
        "haze",
    ),
    Case(
        "element after the last",
        edited("  </startingPaint>", "  </startingPaint><haze/>"),
        "this element does not belong here; remove it",
        line_of("  </startingPaint>"),
        "haze",
    ),
    Case(
        "sample among the spectra",
        edited("  <spectra>\n", '  <spectra>\n    <sample aspecular="9"/>\n'),
        "this element does not belong here; expected here: spectrum",
        line_of("  <spectra>") + 1,
        "sample",
    ),
    wrong(
        "elements inside a text",
        ">metallic<",
        ">metal<b>lic</b><",
        "only text may stand in here",
        element="finish",
        value="metal",
    ),
    Case(
        "text between the elements",
        edited("  <samples", "  about 15 degrees\n  <samples"),
        "text does not belong here: remove it",
        2,
        "colorSpecification",
        "about 15 degrees",
    ),
    wrong(
        "text in an empty element",
        '<gloss value="92.4" angle="60"/>',
        '<gloss value="92.4" angle="60">60</gloss>',
        "text does not belong here: remove it",
        element="gloss",
        value="60",
    ),
]

ATTRIBUTES = [
    wrong(
        "attribute left out",
        ' L="60.1"',
        "",
        "the attribute L is missing: add it",
        element="sample",
        value=None,
    ),
    wrong(
        "observer left out",
        ' observer="10"',
        "",
        "the attribute observer is missing: add it",
        element="samples",
        value=None,
    ),
    wrong(
        "unknown attribute",
        'L="60.1"',
        'L="60.1" c="2.9"',
        "c does not belong here: remove it",
        element="sample",
        value="2.9",
    ),
    wrong(
        "attribute of a text",
        "<name>",
        '<name xml:lang="en">',
        "lang does not belong here: remove it",
        element="name",
        value="en",
    ),
    wrong(
        "xsi:nil",
        "<name>",
        f'<name {_XSI} xsi:nil="true">',
        "xsi:nil and xsi:type do not belong in a colour specification",
        element="name",
        value="Quartz Silver",
    ),
    wrong(
        "xsi:type that loosens a limit",
        "<factor>1.2312",
        f'<factor {_XSI} xsi:type="lightness">99',
        "xsi:nil and xsi:type do not belong in a colour specification",
        element="factor",
        value="lightness",
    ),
    wrong(
        "xsi:type of nothing",
        "<name>",
        f'<name {_XSI} xsi:type="nothing">',
        "xsi:nil and xsi:type do not belong in a colour specification",
        element="name",
        value="nothing",
    ),
]

NOT_XML = [
    Case("empty", "", "the file is empty: write it again"),
    Case("white space alone", " \n\t\n", "the file is empty"),
    Case("declaration alone", DECLARATION, _XML, 1),
    Case("byte-order mark alone", "", _XML, 1, encoding="utf-16"),
    Case("cut off within a tag", COMPLETE[:200], _XML, 6),
    Case("cut off between two tags", COMPLETE[: COMPLETE.index("  <gloss")], _XML, 11),
    Case("last tag cut off", COMPLETE[:-3], _XML, line_of("</colorSpec")),
    Case("two documents in one", COMPLETE + BODY, _XML, COMPLETE.count("\n") + 1),
    Case("text before the declaration", f"x{COMPLETE}", _XML, 1),
    Case("JSON", '{"name": "Quartz Silver"}', _XML, 1),
    Case("NUL inside", edited("Quartz", "Qu\0artz"), _XML, 3),
    Case("attribute twice", edited('L="31"', 'L="31" L="32"'), f"{_XML}.*redefined", 9),
    Case("unbound prefix", edited("<gloss", "<paint:gloss"), f"{_XML}.*paint", 11),
    Case("unknown entity", edited("Quartz", "&eacute;"), f"{_XML}.*eacute", 3),
    Case("control character by reference", edited("Quartz", "&#7;"), _XML, 3),
    Case("NUL by reference", edited("Quartz", "&#0;"), _XML, 3),
    Case("surrogate by reference", edited("Quartz", "&#xD800;"), _XML, 3),
    Case("raw control character", edited("Quartz", "\x1b[2J"), _XML, 3),
    Case("angle bracket in an attribute", edited('"graininess"', '"<"'), _XML, 25),
]

SHAPES = SAMPLES + ROOTS + ELEMENTS + ATTRIBUTES + NOT_XML
