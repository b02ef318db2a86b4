from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest

from paintlink.color import flop_index
from paintlink.design import Design, Start, blank, from_library, from_spec, make_step
from paintlink.design.limits import possible
from paintlink.errors import DesignError, LibraryError
from paintlink.library import bundled, find, paint_spec
from paintlink.model import (
    ColorSpec,
    Gloss,
    Instrument,
    Lab,
    PaintTable,
    Provenance,
    Sample,
)
from tests.design.conftest import FIVE, RED, THREE, make_spec

SIX = (-15.0, *FIVE)


@pytest.fixture(scope="module")
def table() -> PaintTable:
    return bundled()


def at(*angles_deg: float) -> ColorSpec:
    samples = tuple(Sample(angle, Lab(50.0, 10.0, 5.0)) for angle in angles_deg)
    return ColorSpec(name="reading", samples=samples)


@pytest.mark.parametrize(("count", "angles"), [(3, THREE), (5, FIVE)])
def test_known_paint_starts_as_it_is(
    table: PaintTable, count: int, angles: tuple[float, ...]
) -> None:
    code = table.codes[0]

    start = from_library(table, code, count=count)

    paint = paint_spec(table, find(table, code), angles_deg=angles)
    assert start.spec == paint
    assert code in start.source
    assert table.generation in start.source


def test_unknown_code_gets_near_ones(table: PaintTable) -> None:
    with pytest.raises(LibraryError, match="did you mean"):
        from_library(table, table.codes[0] + "9")


def test_every_known_paint_starts_a_design_as_it_is(table: PaintTable) -> None:
    for code in table.codes[::7]:
        start = from_library(table, code, count=5)
        assert "chroma reduced" not in start.source
        assert possible(start.spec.lab())


def test_impossible_reading_keeps_its_hue_and_says_so() -> None:
    spec = make_spec([RED[0], RED[1], (5.0, 3.0, 12.0)])

    start = from_spec(spec, "reading.xml")

    lab = start.spec.lab()
    assert np.array_equal(lab[:2], spec.lab()[:2])
    assert lab[2, 1] / lab[2, 2] == pytest.approx(3.0 / 12.0)
    assert lab[2, 2] == pytest.approx(200.0 / 116.0 * 5.0)
    assert "chroma reduced at 110 degrees" in start.source


def test_reading_below_black_becomes_black() -> None:
    spec = make_spec([RED[0], RED[1], (-0.1, 0.02, 0.01)])

    start = from_spec(spec, "reading.xml")

    assert start.spec.lab(110.0).tolist() == [[0.0, 0.0, 0.0]]


def test_designed_color_has_no_code_of_a_paint(table: PaintTable) -> None:
    design = Design("mine", from_library(table, table.codes[0]))

    assert design.start.spec.code == table.codes[0]
    assert (design.spec.name, design.spec.code) == ("mine", "")


def test_start_keeps_gloss_and_nothing_measured_beside() -> None:
    instrument = Instrument("Maker", "Model", "1", "1")
    spec = ColorSpec(
        name="reading",
        samples=make_spec(RED).samples,
        gloss=Gloss(90.0, 60.0),
        provenance=Provenance(instrument, datetime(2024, 1, 1, tzinfo=UTC), "real"),
    )

    start = from_spec(spec, "reading.xml")

    assert start.spec.gloss == Gloss(90.0, 60.0)
    assert start.spec.provenance is None


def test_six_angles_need_a_choice() -> None:
    with pytest.raises(DesignError, match=r"-15/15/.*ask for 5 angles to leave"):
        from_spec(at(*SIX), "reading.xml")


@pytest.mark.parametrize(("count", "angles"), [(3, THREE), (5, FIVE)])
def test_six_angles_are_narrowed_when_asked(
    count: int, angles: tuple[float, ...]
) -> None:
    start = from_spec(at(*SIX), "reading.xml", count=count)

    assert start.spec.angles_deg == angles


@pytest.mark.parametrize("count", [None, 3, 5])
def test_other_angles_are_refused(count: int | None) -> None:
    with pytest.raises(DesignError, match="25/45/75: start from a colour measured"):
        from_spec(at(25.0, 45.0, 75.0), "old.xml", count=count)


def test_three_angles_never_become_five() -> None:
    with pytest.raises(DesignError, match="reading has 15/45/110: ask for 3"):
        from_spec(at(*THREE), "reading.xml", count=5)


def test_impossible_start_is_refused() -> None:
    with pytest.raises(DesignError, match="no surface can have the colour paint"):
        Start(make_spec([RED[0], RED[1], (5.0, 3.0, 12.0)]), "by hand")


def test_blank_becomes_a_metallic_by_its_end_points() -> None:
    design = Design("silver", blank(count=5))

    for name, values in (
        ("set-face", {"L": 120.0}),
        ("set-flop", {"L": 30.0}),
        ("set-travel", {"vertex_deg": 80.0}),
    ):
        design = design.apply(make_step(name, values))

    lab = design.spec.lab(*THREE)
    index = flop_index(lab)
    assert lab[[0, 2], 0].tolist() == [120.0, 30.0]
    assert index is not None
    assert index > 10.0
