from __future__ import annotations

import csv
import hashlib
import io
import json
import shutil
import subprocess
from dataclasses import asdict, replace
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lxml import etree

from paintlink.errors import ExportError
from paintlink.export import Formats, JobFacts, load_formats, render
from paintlink.model import AngleDifference, ColorSpec, Provenance, StartingPaint
from paintlink.spec import read_spec
from tests.spec.strategies import color_specs

GOLDEN = Path(__file__).parent.parent / "golden" / "export"
FORMATS: Formats = load_formats()
JOB = JobFacts("k7p2m5q3xa", datetime(2025, 3, 14, 9, 27, 1, tzinfo=UTC), "real")
COLORNET_SCHEMA = FORMATS["colornet"].source.with_suffix(".xsd")

# Long texts of nothing but what the output formats treat specially.
SPECIAL_TEXTS = st.text("\"\\\t\n\r=+-@',;<>&]{}é🎨", max_size=500)


def has_starting_paint(spec: ColorSpec) -> bool:
    return spec.starting_paint is not None and spec.starting_paint.code != ""


many = settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)


def golden_spec(name: str) -> ColorSpec:
    return read_spec((GOLDEN / f"{name}.xml").read_bytes())


def rows_of(data: bytes) -> list[dict[str, str]]:
    text = data.decode("utf-8-sig")
    return list(csv.DictReader(io.StringIO(text, newline=""), strict=True))


@pytest.mark.parametrize("format_id", FORMATS)
@pytest.mark.parametrize("name", ["measured", "designed"])
def test_format_gives_its_golden_bytes(format_id: str, name: str) -> None:
    file = render(golden_spec(name), FORMATS[format_id], job=JOB)

    golden = GOLDEN / format_id / f"{name}.{FORMATS[format_id].suffix}"
    assert golden.is_file(), f"{format_id} has no golden file {golden}"
    assert file.data == golden.read_bytes()


def test_hash_belongs_to_the_bytes() -> None:
    file = render(golden_spec("measured"), FORMATS["json"], job=JOB)

    assert file.sha256 == hashlib.sha256(file.data).hexdigest()
    assert file.format_id == "json"


@many
@given(spec=color_specs())
def test_json_holds_the_specification_exactly(spec: ColorSpec) -> None:
    job = replace(JOB, copy=3)

    data = render(spec, FORMATS["json"], job=job).data
    found = json.loads(data, parse_int=float)

    measured = spec.provenance
    origin = measured.origin if measured else "real"
    assert found.pop("format") == "paintlink-color-1"
    assert found.pop("job") == {
        "id": "k7p2m5q3xa",
        "created": "2025-03-14T09:27:01Z",
        "origin": origin,
        "copy": 3,
    }
    assert found == without_nothing({
        "name": spec.name,
        "code": spec.code or None,
        "finish": spec.finish,
        "illumination_deg": 45,
        "illuminant": "D65",
        "observer_deg": int(spec.observer),
        "samples": [
            {"aspecular_deg": one.aspecular_deg, **one.lab._asdict()}
            for one in spec.samples
        ],
        "gloss": spec.gloss and without_nothing(asdict(spec.gloss)),
        "spectra": [
            asdict(one) | {"factors": list(one.factors)} for one in spec.spectra
        ]
        or None,
        "textures": [without_nothing(asdict(one)) for one in spec.texture] or None,
        "measurement": measured and json_measurement(measured),
        "starting_paint": spec.starting_paint and json_paint(spec.starting_paint),
    })


def json_measurement(measured: Provenance) -> dict[str, object]:
    instrument = measured.instrument
    time = measured.taken_at.astimezone(UTC).replace(tzinfo=None)
    return without_nothing({
        "maker": instrument.maker,
        "model": instrument.model,
        "serial": instrument.serial or None,
        "firmware": instrument.firmware or None,
        "time": f"{time.isoformat()}Z",
        "origin": measured.origin,
        "averaged": measured.averaged,
        "calibration": measured.calibration,
        "data_mode": measured.data_mode or None,
    })


def json_paint(paint: StartingPaint) -> dict[str, object]:
    return asdict(paint) | {"differences": [one._asdict() for one in paint.differences]}


def without_nothing(values: dict[str, object]) -> dict[str, object]:
    return {name: value for name, value in values.items() if value is not None}


@many
@given(text=SPECIAL_TEXTS)
def test_json_escapes_long_special_texts(text: str) -> None:
    spec = replace(golden_spec("designed"), name=text)

    assert json.loads(render(spec, FORMATS["json"], job=JOB).data)["name"] == text


@many
@given(spec=color_specs())
def test_csv_holds_the_numbers_exactly(spec: ColorSpec) -> None:
    rows = rows_of(render(spec, FORMATS["csv"], job=JOB).data)

    assert [
        tuple(float(row[name]) for name in ("aspecular_deg", "L", "a", "b"))
        for row in rows
    ] == [(one.aspecular_deg, *one.lab) for one in spec.samples]
    gloss = (spec.gloss.value_gu, spec.gloss.angle_deg) if spec.gloss else (None, None)
    for row in rows:
        assert (cell(row["gloss_gu"]), cell(row["gloss_angle_deg"])) == gloss


def cell(text: str) -> float | None:
    return float(text) if text else None


def test_csv_puts_each_difference_beside_its_angle() -> None:
    spec = golden_spec("measured")

    rows = rows_of(render(spec, FORMATS["csv"], job=JOB).data)

    found = {
        float(row["aspecular_deg"]): [
            cell(row[name]) for name in AngleDifference._fields[1:]
        ]
        for row in rows
    }
    expected = {
        one.aspecular_deg: list(one[1:]) for one in spec.starting_paint.differences
    }
    assert found == dict.fromkeys(spec.angles_deg, [None] * 6) | expected


@many
@given(name=SPECIAL_TEXTS, paint=SPECIAL_TEXTS)
def test_csv_text_starts_no_formula(name: str, paint: str) -> None:
    spec = golden_spec("measured")
    spec = replace(
        spec, name=name, starting_paint=replace(spec.starting_paint, code=paint)
    )

    rows = rows_of(render(spec, FORMATS["csv"], job=JOB).data)

    assert len(rows) == len(spec.samples)
    for row in rows:
        for text, found in ((name, row["name"]), (paint, row["starting_paint"])):
            is_formula = text[:1] in set("=+-@\t\r")
            assert found == ("'" + text if is_formula else text)


@many
@given(spec=color_specs().filter(has_starting_paint))
def test_colornet_job_holds_texts_and_numbers(spec: ColorSpec) -> None:
    root = etree.fromstring(render(spec, FORMATS["colornet"], job=JOB).data)

    space = {"": "urn:paintlink:colornet-job:1"}
    labs = [
        tuple(float(one.get(name)) for name in ("aspecular", "L", "a", "b"))
        for one in root.iterfind("target/lab", space)
    ]
    differences = [
        tuple(float(one.get(name)) for name in ("aspecular", *one.keys()[1:]))
        for one in root.iterfind("startingPaint/differences/difference", space)
    ]
    paint = spec.starting_paint
    assert (root.findtext("name", namespaces=space) or "") == spec.name
    assert root.findtext("startingPaint/code", namespaces=space) == paint.code
    assert labs == [(one.aspecular_deg, *one.lab) for one in spec.samples]
    assert differences == [tuple(one) for one in paint.differences]
    etree.XMLSchema(file=str(COLORNET_SCHEMA)).assertValid(root)


@pytest.mark.skipif(shutil.which("xmllint") is None, reason="xmllint is not installed")
@pytest.mark.parametrize("name", ["measured", "designed"])
def test_colornet_job_satisfies_its_schema(tmp_path: Path, name: str) -> None:
    path = tmp_path / "job.xml"
    path.write_bytes(render(golden_spec(name), FORMATS["colornet"], job=JOB).data)

    check = ["xmllint", "--noout", "--schema", str(COLORNET_SCHEMA), str(path)]
    done = subprocess.run(check, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr) == (0, f"{path} validates\n")


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        (' origin="real"', ""),
        ('aspecular="45" L', 'aspecular="15" L'),
        ('L="60"', 'L="sixty"'),
        ("<code>-RM&quot;331</code>", "<code/>"),
        ("<finish>pearl</finish>", ""),
    ],
)
def test_colornet_schema_refuses_what_is_wrong(right: str, wrong: str) -> None:
    schema = etree.XMLSchema(file=str(COLORNET_SCHEMA))
    data = render(golden_spec("designed"), FORMATS["colornet"], job=JOB).data
    text = data.decode().replace('"331', "&quot;331")

    assert right in text
    assert schema.validate(etree.fromstring(text.encode()))
    assert not schema.validate(etree.fromstring(text.replace(right, wrong).encode()))


@pytest.mark.parametrize("paint", ["none", "without code"])
def test_missing_starting_paint_sends_to_colorsnap(paint: str) -> None:
    spec = golden_spec("measured")
    without_code = replace(spec.starting_paint, code="")
    spec = replace(spec, starting_paint=without_code if paint != "none" else None)

    with pytest.raises(
        ExportError, match=r"ColorNet job .* needs a starting paint and 'Blaumetallic "
    ) as caught:
        render(spec, FORMATS["colornet"], job=JOB)

    assert caught.value.kind == "starting-paint"
    assert "run ColorSnap first" in str(caught.value)


@pytest.mark.parametrize("format_id", ["csv", "json"])
def test_other_formats_need_no_starting_paint(format_id: str) -> None:
    spec = replace(golden_spec("designed"), starting_paint=None)

    assert render(spec, FORMATS[format_id], job=JOB).data


@pytest.mark.parametrize("format_id", FORMATS)
@pytest.mark.parametrize("source", ["job", "measurement"])
def test_simulated_reading_is_marked_in_name_and_file(
    format_id: str, source: str
) -> None:
    spec = golden_spec("measured" if source == "measurement" else "designed")
    job = replace(JOB, origin="simulated") if source == "job" else JOB

    file = render(spec, FORMATS[format_id], job=job)

    assert file.name.startswith("SIM-")
    assert b"simulated" in file.data


def test_real_reading_carries_no_mark() -> None:
    file = render(golden_spec("designed"), FORMATS["json"], job=JOB)

    assert not file.name.startswith("SIM-")
    assert json.loads(file.data)["job"]["origin"] == "real"


def test_name_follows_the_pattern_of_the_format() -> None:
    pattern = "{date}T{time}_{name}_{code}_{paint}_{format}_{copy}_{id6}"
    format = replace(FORMATS["json"], name_pattern=pattern)

    name = render(golden_spec("measured"), format, job=JOB).name

    stem, _, rest = name.partition("_json_1_")
    assert stem == "SIM-20250314T092701_Blaumetallic_hell_B-1724_BM304"
    id6, digest = rest.removesuffix(".json").split("-")
    assert digest.startswith(id6)
    assert len(id6) == 6


def test_name_gives_the_date_in_utc() -> None:
    late = datetime(2025, 3, 14, 23, 30, tzinfo=timezone(timedelta(hours=-5)))

    file = render(
        golden_spec("designed"), FORMATS["json"], job=replace(JOB, created_at=late)
    )

    assert file.name.startswith("20250315_")
    assert json.loads(file.data)["job"]["created"] == "2025-03-15T04:30:00Z"


def test_every_job_format_and_copy_has_its_own_name() -> None:
    spec = golden_spec("measured")
    jobs = [JOB, replace(JOB, id="another"), replace(JOB, copy=2)]

    names = {
        render(spec, one, job=job).name for job in jobs for one in FORMATS.values()
    }

    assert len(names) == len(jobs) * len(FORMATS)
