"""docs/specification.md says what the schema says."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from lxml import etree

from paintlink.spec import NAMESPACE, read_spec, schema_path
from paintlink.spec.document import MAX_BYTES, MAX_NODES
from paintlink.spec.schema import facets

PAGE = (Path(__file__).parents[2] / "docs" / "specification.md").read_text()
XS = {"xs": "http://www.w3.org/2001/XMLSchema"}
SCHEMA = etree.parse(schema_path())


def example() -> bytes:
    found = re.search(r"```xml\n(.*?)```", PAGE, re.DOTALL)
    assert found
    return found[1].encode()


def table_of_types() -> dict[str, tuple[str, str]]:
    rows = re.findall(r"^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|", PAGE, re.MULTILINE)
    start = [name for name, *_ in rows].index("angle")
    return {name: (lowest, highest) for name, lowest, highest in rows[start:]}


def test_example_is_read() -> None:
    spec = read_spec(example())

    assert spec.angles_deg == (15, 45, 110)


def test_command_of_the_page_validates_the_example(tmp_path: Path) -> None:
    if shutil.which("xmllint") is None:
        pytest.skip("xmllint is not installed")
    shutil.copy(schema_path(), tmp_path)
    (tmp_path / "example.xml").write_bytes(example())
    found = re.search(r"`(xmllint [^`]*)`", PAGE)
    assert found
    command = found[1].replace("FILE", "example.xml").split()

    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, check=False
    )

    assert (done.returncode, done.stderr) == (0, "example.xml validates\n")


def test_example_shows_every_element_and_attribute() -> None:
    root = etree.fromstring(example())
    shown = {etree.QName(node).localname for node in root.iter("{*}*")}
    shown |= {str(name) for node in root.iter("{*}*") for name in node.attrib}

    assert shown == {
        node.get("name") for node in SCHEMA.iter("{*}element", "{*}attribute")
    }


def test_field_table_names_every_element_and_attribute() -> None:
    table = PAGE[PAGE.index("## Fields") : PAGE.index("## Types")]
    named = set(re.findall(r"\w+", " ".join(re.findall(r"`[^`]*`", table))))

    fields = {node.get("name") for node in SCHEMA.iter("{*}element", "{*}attribute")}
    assert fields - {"colorSpecification"} <= named


def test_type_table_gives_the_limits_of_the_schema() -> None:
    table = table_of_types()
    largest = facets("number")["maxInclusive"]
    words = {"the largest double": largest, "the smallest double": f"-{largest}"}

    assert len(table) == 10
    for name, (lowest, highest) in table.items():
        found = {"maxInclusive": "2147483647", **facets(name)}
        if "minExclusive" in found:
            assert lowest == f"above {found['minExclusive']}"
        else:
            assert words.get(lowest, lowest) == found["minInclusive"]
        assert words.get(highest, highest) == found["maxInclusive"]


def test_page_gives_the_counts_of_the_schema() -> None:
    for name in ("spectrum", "factor", "texture", "difference"):
        most = SCHEMA.find(f".//xs:element[@name='{name}']", XS).get("maxOccurs")
        row = re.search(rf"^\| `\w+/{name}` \|([^|]*)\|", PAGE, re.MULTILINE)
        assert row
        assert re.search(rf"\bto {most} $", row[1])


def test_page_gives_the_limits_of_the_reader() -> None:
    assert f"{MAX_BYTES >> 20} MiB and {MAX_NODES // 1000} 000 elements" in PAGE
    assert facets("text")["maxLength"] == "500"
    assert "at most 500 characters" in PAGE
    assert NAMESPACE in PAGE
