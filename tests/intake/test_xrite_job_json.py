"""X-Rite job data: base64 spectra, data modes, damaged documents."""

from __future__ import annotations

import base64
import json
import time
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest

from paintlink.errors import InputError
from paintlink.intake import Import, Options, read_any
from tests.intake.fixtures import paint
from tests.intake.fixtures.xrite_job_json import SIX, STAMP, document, job, values


def imported(content: Any, **options: object) -> Import:
    data = content if isinstance(content, bytes) else json.dumps(content).encode()
    return read_any(data, name="job.json", options=Options(**options))  # type: ignore[arg-type]


def refusal(content: Any, **options: object) -> str:
    with pytest.raises(InputError, match=r"job\.json") as caught:
        imported(content, **options)
    return str(caught.value)


def measurement(content: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = content["measurementSet"]["measurements"][0]
    return found


def test_job_gives_its_reading_with_everything_it_says() -> None:
    found = imported(document())

    (item,) = found.items
    assert found.format_id == "xrite_job_json"
    assert item.spec is not None
    assert item.spec.angles_deg == (-15, 15, 25, 45, 75, 110)
    reading = item.reading
    assert reading is not None
    assert reading.sample == "Basalt 7"
    assert reading.taken_at == datetime.fromtimestamp(STAMP, UTC)
    assert reading.instrument.model == "MA-5 QC"
    assert reading.instrument.serial == "000123"
    measured = reading.measurement
    assert measured.data_mode == "ma3_5"
    assert measured.record == "20260314_082653/1"
    assert measured.spectra is not None
    wanted = paint.factors(SIX).astype("<f4").astype(np.float64)
    assert np.array_equal(measured.spectra.factors, wanted)
    assert measured.texture[0].name == "Sparkle Grade 45as15"


def test_spectra_as_plain_lists_are_the_same() -> None:
    content = job()
    for one in measurement(content)["colorValues"]["ma3_5"]:
        data = base64.b64decode(one["spectral"]["values"])
        one["spectral"]["values"] = np.frombuffer(data, "<f4").astype(float).tolist()

    plain, packed = imported(content).items[0].reading, imported(job()).items[0].reading

    assert plain is not None
    assert packed is not None
    assert plain.measurement.spectra is not None
    assert packed.measurement.spectra is not None
    assert np.array_equal(
        plain.measurement.spectra.factors, packed.measurement.spectra.factors
    )


def test_answer_of_the_bridge_and_lists_of_jobs_are_read() -> None:
    answer = {"success": True, "measurement": job()}

    assert len(imported(answer).items) == 1
    assert len(imported([job(), job()]).items) == 2


def test_failure_reported_by_the_bridge_is_passed_on() -> None:
    answer = {"success": False, "errorCode": 3, "errorMessage": "no instrument"}

    assert (
        "the instrument reported a failure (no instrument): measure again"
        in refusal(answer)
    )


def test_one_of_several_data_modes_is_taken_and_told() -> None:
    content = job(ma9x=values(1), ma3_5=values(2))

    native = imported(content)
    wanted = imported(content, data_mode="ma9x")

    assert native.items[0].reading is not None
    assert native.items[0].reading.measurement.data_mode == "ma3_5"
    assert native.notes == (
        "data mode ma3_5 taken; the file also has ma9x: --data-mode",
    )
    assert wanted.items[0].spec != native.items[0].spec
    assert "no values in data mode 'byk'; there are ma9x, ma3_5" in refusal(
        content, data_mode="byk"
    )


def test_several_measurements_of_a_set_are_numbered() -> None:
    content = job()
    content["measurementSet"]["measurements"].append(
        measurement(job(ma3_5=values(1))) | {"id": "2"}
    )

    assert [one.name for one in imported(content).items] == ["Basalt 7 1", "Basalt 7 2"]


@pytest.mark.parametrize(
    ("spectrum", "told"),
    [
        ("!!!", "no base64 of 32-bit numbers: damaged or cut, export again"),
        (base64.b64encode(b"12345").decode(), "no base64 of 32-bit numbers"),
        ("", "0 values are no spectrum: export again"),
        (base64.b64encode(b"\0\0\xc0\x7f" * 31).decode(), "value 1 is no number"),
        ([0.5, "x"], "values[1]: a number is expected here"),
        ([0.5, None], "values[1]: a number is expected here"),
        ([0.5, 1e400], "the number is too large"),
        (
            base64.b64encode(b"\0\0\0\x3f" * 2000).decode(),
            "2000 values are no spectrum",
        ),
    ],
)
def test_damaged_spectrum_is_told_with_its_path(spectrum: object, told: str) -> None:
    content = job()
    measurement(content)["colorValues"]["ma3_5"][2]["spectral"]["values"] = spectrum

    text = refusal(json.dumps(content).replace("Infinity", "1e400").encode())

    assert "measurements[0].colorValues.ma3_5[2].spectral.values" in text
    assert told in text


def test_doubled_geometry_and_unknown_code_are_told_with_their_path() -> None:
    doubled, unknown = job(), job()
    measurement(doubled)["colorValues"]["ma3_5"][1]["geometry"] = "r45as-15"
    measurement(unknown)["colorValues"]["ma3_5"][1]["geometry"] = "sphere"

    assert "ma3_5[1]: geometry r45as-15 stands twice" in refusal(doubled)
    assert "ma3_5[1].geometry: geometry 'sphere' is diffuse" in refusal(unknown)


def test_missing_angles_refuse_the_reading() -> None:
    (item,) = imported(job(ma3_5=values(0, ("45as15", "45as45")))).items

    assert item.spec is None
    assert "it holds the aspecular angles 15, 45" in item.refused


def test_percent_is_told_with_the_option() -> None:
    content = job()
    for one in measurement(content)["colorValues"]["ma3_5"]:
        one.pop("lab")
        spectra = np.frombuffer(base64.b64decode(one["spectral"]["values"]), "<f4")
        one["spectral"]["values"] = (100.0 * spectra).tolist()

    assert "import with --scale percent" in refusal(content)
    assert imported(content, scale="percent").items[0].spec is not None


def test_mixed_conditions_in_a_reading_are_refused() -> None:
    content = job()
    measurement(content)["colorValues"]["ma3_5"][3]["lab"]["observer"] = 2

    assert "Lab is for D65/10 and for D65/2 in one reading" in refusal(content)


def test_unknown_illuminant_leaves_lab_out() -> None:
    content = job()
    for one in measurement(content)["colorValues"]["ma3_5"]:
        one["lab"]["illuminant"] = "F7"

    found = imported(content)

    assert found.items[0].spec is not None
    assert any("illuminant 'F7' is unknown" in note for note in found.notes)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.97])
def test_cut_document_is_told_with_line_and_column(share: float) -> None:
    data = document()

    text = refusal(data[: int(share * len(data))])

    assert "job.json, line" in text
    assert "damaged or cut JSON" in text


def test_constants_that_are_no_json_are_refused() -> None:
    content = job()
    measurement(content)["temperature"] = float("nan")

    assert "NaN stands where a number is expected" in refusal(content)


BOMBS = {
    "nested too deeply": b'{"measurementSet":' + b"[" * 100_000,
    "more values than a job has": b'{"measurementSet":[' + b"[]," * 4_000_000 + b"0]}",
    "Exceeds the limit": b'{"measurementSet":' + b"9" * 5_000_000 + b"}",
}


@pytest.mark.parametrize("told", BOMBS)
def test_document_that_would_cost_too_much_is_refused_at_once(told: str) -> None:
    start = time.process_time()

    assert told in refusal(BOMBS[told])

    assert time.process_time() - start < 5.0


def test_other_json_is_told_what_is_missing() -> None:
    assert "no measurementSet in it: export a job of readings" in refusal({"a": 1})
