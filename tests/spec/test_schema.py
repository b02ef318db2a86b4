from __future__ import annotations

import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import get_args

import pytest
from lxml import etree

from paintlink.model import (
    AB_RANGE,
    ASPECULAR_RANGE_DEG,
    FINISHES,
    GLOSS_ANGLES_DEG,
    GLOSS_RANGE_GU,
    L_RANGE,
    OBSERVERS,
    SAMPLE_COUNTS,
    CalibrationState,
    Origin,
)
from paintlink.spec import NAMESPACE, schema_path
from paintlink.spec.document import MAX_NODES
from paintlink.spec.schema import facets, field_type
from paintlink.spec.violations import RULES
from tests.spec.accepted import ACCEPTED
from tests.spec.corpus import COMPLETE, Case
from tests.spec.refused_shapes import SHAPES
from tests.spec.refused_values import VALUES

XS = {"xs": "http://www.w3.org/2001/XMLSchema"}
SCHEMA = etree.parse(schema_path())


def validated(folder: Path, documents: Sequence[bytes]) -> set[int]:
    """Numbers of the documents that xmllint finds valid, in one call."""
    if shutil.which("xmllint") is None:
        pytest.skip("xmllint is not installed")
    names = [f"{number}.xml" for number in range(len(documents))]
    for name, document in zip(names, documents, strict=True):
        (folder / name).write_bytes(document)
    check = ["xmllint", "--nonet", "--noout", "--schema", str(schema_path()), *names]
    done = subprocess.run(check, cwd=folder, capture_output=True, check=False)
    lines = done.stderr.decode(errors="replace").splitlines()
    return {names.index(line[:-10]) for line in lines if line.endswith(" validates")}


def limits(type_name: str) -> tuple[float, float]:
    found = facets(type_name)
    return float(found["minInclusive"]), float(found["maxInclusive"])


@pytest.mark.parametrize(
    ("type_name", "expected"),
    [
        ("angle", ASPECULAR_RANGE_DEG),
        ("lightness", L_RANGE),
        ("chromaticity", AB_RANGE),
        ("glossUnits", GLOSS_RANGE_GU),
    ],
)
def test_limits_are_those_of_the_model(
    type_name: str, expected: tuple[float, float]
) -> None:
    assert limits(type_name) == expected


@pytest.mark.parametrize(
    ("type_name", "expected"),
    [
        ("finish", FINISHES),
        ("observer", OBSERVERS),
        ("origin", get_args(Origin)),
        ("calibration", get_args(CalibrationState)),
        ("glossAngle", [f"{angle:g}" for angle in GLOSS_ANGLES_DEG]),
    ],
)
def test_words_are_those_of_the_model(type_name: str, expected: Sequence[str]) -> None:
    assert facets(type_name)["enumeration"] == ", ".join(expected)


def test_own_limits_come_before_inherited_ones() -> None:
    found = facets("nonNegativeNumber")

    assert found["minInclusive"] == "0"
    assert found["maxInclusive"] == "1.7976931348623157E308"
    assert found["primitive"] == "xs:double"


@pytest.mark.parametrize(
    ("element", "attribute", "expected"),
    [
        ("sample", "L", "lightness"),
        ("gloss", "angle", "glossAngle"),
        ("texture", "angle", "angle"),
        ("factor", None, "reflectanceFactor"),
        ("haze", None, ""),
        ("sample", "haze", ""),
        ('it\'s "quoted"', "]", ""),
    ],
)
def test_type_of_field_comes_from_schema(
    element: str, attribute: str | None, expected: str
) -> None:
    assert field_type(element, attribute) == expected


def test_every_simple_type_has_a_rule() -> None:
    names = {node.get("name") for node in SCHEMA.iterfind("xs:simpleType", XS)}

    assert names == set(RULES)


@pytest.mark.parametrize("type_name", sorted(RULES))
def test_rule_is_filled_from_the_schema(type_name: str) -> None:
    rule = RULES[type_name].format_map(facets(type_name))

    assert rule.startswith("must ")
    assert "{" not in rule


def test_every_kind_of_thing_is_explained() -> None:
    explained = {
        node.getparent().getparent().get("name")
        for node in SCHEMA.iterfind(".//xs:documentation", XS)
    }
    fields = {"sample", "gloss", "spectrum", "texture", "measurement", "startingPaint"}

    assert fields | {"lightness", "angle", "reflectanceFactor", "utcTime"} <= explained


def test_namespace_is_the_one_in_the_schema() -> None:
    assert SCHEMA.getroot().get("targetNamespace") == NAMESPACE


def test_xmllint_takes_3_5_or_6_samples(tmp_path: Path) -> None:
    start, end = COMPLETE.index("    <sample "), COMPLETE.index("  </samples>")
    rows = [f'<sample aspecular="{n}" L="1" a="0" b="0"/>' for n in range(9)]
    documents = [
        f"{COMPLETE[:start]}{''.join(rows[:count])}{COMPLETE[end:]}".encode()
        for count in range(len(rows) + 1)
    ]

    assert validated(tmp_path, documents) == set(SAMPLE_COUNTS)


def test_xmllint_takes_what_paintlink_takes(tmp_path: Path) -> None:
    documents = [case.data() for case in ACCEPTED]

    valid = validated(tmp_path, documents)

    refused = set(range(len(ACCEPTED))) - valid
    assert [ACCEPTED[number].name for number in sorted(refused)] == []


def _beyond_the_schema(case: Case) -> bool:
    """True for what format 1 refuses although XML Schema cannot say so."""
    return case.name == "zero in two signs"


def test_xmllint_refuses_what_paintlink_refuses(tmp_path: Path) -> None:
    cases = [case for case in VALUES + SHAPES if not _beyond_the_schema(case)]

    valid = validated(tmp_path, [case.data() for case in cases])

    assert [cases[number].name for number in sorted(valid)] == []


def test_reader_has_room_for_all_the_schema_allows() -> None:
    factors, spectra, textures, differences = (
        int(SCHEMA.find(f".//xs:element[@name='{name}']", XS).get("maxOccurs"))
        for name in ("factor", "spectrum", "texture", "difference")
    )
    most = spectra * (factors + 4) + textures * 4 + differences * 8

    assert most + 100 < MAX_NODES
