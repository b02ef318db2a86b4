from __future__ import annotations

import dataclasses
import shutil
import subprocess
from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given, settings
from lxml import etree

from paintlink.model import ColorSpec
from paintlink.spec import read_spec, schema_path, write_spec
from tests.spec.extremes import Extremes, random_spec
from tests.spec.strategies import color_specs

MANY = 10_000
PER_CALL = 2_500


def bits(value: object) -> object:
    """The value with every double spelled bit for bit and every time in UTC."""
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, datetime):
        return value.astimezone(UTC).isoformat()
    if dataclasses.is_dataclass(value):
        return [bits(getattr(value, field.name)) for field in dataclasses.fields(value)]
    return [bits(part) for part in value] if isinstance(value, tuple) else value


@settings(max_examples=200, deadline=None)
@given(color_specs())
def test_any_specification_round_trips(spec: ColorSpec) -> None:
    data = write_spec(spec)

    assert bits(read_spec(data)) == bits(spec)
    assert write_spec(read_spec(data)) == data


@settings(max_examples=50, deadline=None)
@given(color_specs())
def test_xpath_1_reads_every_number(spec: ColorSpec) -> None:
    root = etree.fromstring(write_spec(spec))

    unread = root.xpath("//@*[number() != number()]/..")

    names = {etree.QName(node).localname for node in unread}
    assert names <= {"samples", "texture"}  # illuminant and name are words


@pytest.mark.timeout(600)
def test_extreme_specifications_round_trip_and_validate(tmp_path: Path) -> None:
    if shutil.which("xmllint") is None:
        pytest.skip("xmllint is not installed")
    extremes = Extremes(seed=20250314)
    for count in range(MANY):
        spec = random_spec(extremes)
        data = write_spec(spec)
        (tmp_path / f"{count}.xml").write_bytes(data)

        assert bits(read_spec(data)) == bits(spec)

    for start in range(0, MANY, PER_CALL):
        names = [f"{count}.xml" for count in range(start, start + PER_CALL)]
        check = ["xmllint", "--nonet", "--noout", "--schema", str(schema_path())]
        done = subprocess.run(
            [*check, *names], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr[-2000:]
        assert done.stderr.splitlines() == [f"{name} validates" for name in names]
