from __future__ import annotations

import re
from datetime import UTC, datetime

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from paintlink.errors import SpecError
from paintlink.model import (
    AngleDifference,
    ColorSpec,
    Gloss,
    Instrument,
    Lab,
    Provenance,
    Sample,
    Spectrum,
    StartingPaint,
    Texture,
)
from paintlink.spec import read_spec, write_spec
from tests.spec.accepted import ACCEPTED
from tests.spec.corpus import COMPLETE, Case, edited
from tests.spec.hostile import HOSTILE
from tests.spec.refused_shapes import SHAPES
from tests.spec.refused_values import VALUES

REFUSED = VALUES + SHAPES + HOSTILE

EXPECTED = ColorSpec(
    name="Quartz Silver",
    code="DM412",
    finish="metallic",
    observer="10",
    samples=(
        Sample(15, Lab(112.31, -1.02, -3.4)),
        Sample(45, Lab(60.1, -1.1, -2.75)),
        Sample(110, Lab(31, -0.98, -2)),
    ),
    gloss=Gloss(92.4, 60),
    spectra=(
        Spectrum(15, 400, 10, (1.2271, 1.2312, -0.0004)),
        Spectrum(45, 400, 10, (0.2811, 0.2813)),
    ),
    texture=(
        Texture("sparkle intensity", 3.21, 15),
        Texture("graininess", 2.07),
    ),
    provenance=Provenance(
        Instrument("Example Optics", "MA-6", "004711", "2.1"),
        taken_at=datetime(2025, 3, 14, 9, 26, 53, 589793, tzinfo=UTC),
        origin="simulated",
        averaged=3,
        calibration="valid",
        data_mode="45as all",
    ),
    starting_paint=StartingPaint(
        code="DM398",
        library="demo",
        generation="2025-01",
        formula="CIE76",
        total=4.75,
        differences=(
            AngleDifference(15, 2.5, 1.5, 2, 0, -0.25, 0.125),
            AngleDifference(45, 2.25, -2.25, 0, 0, 0, 0),
        ),
    ),
)


def test_complete_document_becomes_the_value() -> None:
    spec = read_spec(COMPLETE.encode())

    assert spec == EXPECTED


@pytest.mark.parametrize("case", ACCEPTED, ids=str)
def test_other_spelling_means_the_same(case: Case) -> None:
    spec = read_spec(case.data())

    assert spec == EXPECTED


def test_left_out_parts_become_defaults() -> None:
    start, end = COMPLETE.index("  <gloss"), COMPLETE.index("</colorSpecification>")
    minimal = edited("  <code>DM412</code>\n", "", COMPLETE[:start] + COMPLETE[end:])

    spec = read_spec(minimal.encode())

    assert spec == ColorSpec("Quartz Silver", EXPECTED.samples, "metallic")


def test_left_out_measurement_details_become_defaults() -> None:
    start, end = COMPLETE.index("    <averaged"), COMPLETE.index("  </measurement>")

    provenance = read_spec((COMPLETE[:start] + COMPLETE[end:]).encode()).provenance

    assert provenance is not None
    assert (provenance.averaged, provenance.calibration) == (1, "unknown")
    assert provenance.data_mode == ""


@pytest.mark.parametrize("count", [3, 5, 6])
def test_allowed_sample_counts_are_read(count: int) -> None:
    rows = "".join(f'<sample aspecular="{n}" L="1" a="0" b="0"/>' for n in range(count))
    start, end = COMPLETE.index("    <sample "), COMPLETE.index("  </samples>")

    spec = read_spec((COMPLETE[:start] + rows + COMPLETE[end:]).encode())

    assert spec.angles_deg == tuple(range(count))


@pytest.mark.parametrize("case", REFUSED, ids=str)
def test_refusal_names_place_value_and_remedy(case: Case) -> None:
    with pytest.raises(SpecError, match=case.words) as caught:
        read_spec(case.data(), source="inbox/quartz.xml")

    error = caught.value
    assert (error.line, error.element, error.value) == (
        case.line,
        case.element,
        case.value,
    )
    assert str(error).startswith("inbox/quartz.xml")
    assert len(str(error)) < 500


def test_refused_documents_are_many_and_different() -> None:
    assert len({case.data() for case in REFUSED}) == len(REFUSED) >= 60


def test_refusal_without_source_starts_with_line() -> None:
    with pytest.raises(SpecError, match=r"^line 8, <sample>: L must lie"):
        read_spec(edited('L="60.1"', 'L="171"').encode())


def test_refusal_finds_place_in_prefixed_document() -> None:
    prefixed = next(case for case in ACCEPTED if case.name == "prefix")
    data = edited('L="60.1"', 'L="171"', prefixed.text).encode()

    with pytest.raises(SpecError, match=r"line 8, <sample>: L must .*\(found '171'\)"):
        read_spec(data)


def test_refusal_survives_prefix_declared_deep_inside() -> None:
    data = edited("  <gloss", '  <x:gloss xmlns:x="urn:x"/>\n  <gloss').encode()

    with pytest.raises(SpecError, match="line 11, <gloss>: this element does not"):
        read_spec(data)


def _mutated(data: bytes) -> st.SearchStrategy[bytes]:
    """The document with a few stretches overwritten by other bytes."""
    place = st.integers(0, len(data))
    pieces = st.sampled_from(re.findall(rb"<[^>]*>|[^<>]+", data))
    patch = st.tuples(place, st.integers(0, 12), st.binary(max_size=6) | pieces)

    def apply(patches: list[tuple[int, int, bytes]]) -> bytes:
        mutated = data
        for start, length, replacement in patches:
            mutated = mutated[:start] + replacement + mutated[start + length :]
        return mutated

    return st.lists(patch, min_size=1, max_size=3).map(apply)


@settings(max_examples=400, deadline=None)
@given(_mutated(COMPLETE.encode()) | _mutated(COMPLETE.encode("utf-16")))
def test_mutated_document_is_read_or_refused(data: bytes) -> None:
    try:
        spec = read_spec(data)
    except SpecError:
        return

    assert read_spec(write_spec(spec)) == spec
