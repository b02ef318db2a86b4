from __future__ import annotations

import numpy as np
import pytest

from paintlink.design import Design, make_step
from paintlink.errors import DesignError
from paintlink.model import ColorSpec, Lab, Sample
from tests.design.conftest import RED, make_design, make_spec

LIGHTER = make_step("exposure", {"stops": 0.5})
TURNED = make_step("rotate-hue", {"angle_deg": -20.0})
PALER = make_step("chroma", {"factor": 0.5})


@pytest.fixture
def design() -> Design:
    return make_design().apply(LIGHTER).apply(TURNED).apply(PALER)


def test_design_without_steps_is_its_start() -> None:
    design = make_design()

    assert np.array_equal(design.state.lab, RED)
    assert design.history() == ()


def test_result_is_an_ordinary_specification(design: Design) -> None:
    spec = design.spec

    assert spec.name == "designed"
    assert (spec.finish, spec.observer, spec.code) == ("metallic", "10", "")
    assert spec.provenance is None
    assert np.array_equal(spec.lab(), design.state.lab)


def test_undone_steps_come_back_in_order(design: Design) -> None:
    shorter = design.undo().undo()

    assert shorter.steps == (LIGHTER,)
    assert shorter.redo().steps == (LIGHTER, TURNED)
    assert shorter.redo().redo() == design


def test_undo_of_many_is_many_undos(design: Design) -> None:
    assert design.undo(3) == design.undo().undo().undo()
    assert design.undo(3).redo(2) == design.undo()


def test_new_step_forgets_what_was_undone(design: Design) -> None:
    changed = design.undo(2).apply(PALER)

    assert changed.steps == (LIGHTER, PALER)
    with pytest.raises(DesignError, match="nothing to redo"):
        changed.redo()


def test_undo_brings_back_the_hue_that_was_lost() -> None:
    grey = make_design().apply(make_step("chroma", {"factor": 0.0}))

    assert grey.undo().state.lab.tobytes() == np.array(RED).tobytes()


@pytest.mark.parametrize("count", [0, -1, 4])
def test_impossible_count_of_undos_is_refused(design: Design, count: int) -> None:
    with pytest.raises(
        DesignError, match=rf"cannot undo {count} steps: ask for 1 to 3"
    ):
        design.undo(count)


def test_nothing_to_undo_is_said() -> None:
    with pytest.raises(DesignError, match="nothing to undo"):
        make_design().undo()


def test_solid_has_no_flop_index_to_scale() -> None:
    solid = make_design([RED[1]] * 3)

    with pytest.raises(DesignError, match="no travel in L to scale"):
        solid.apply(make_step("set-flop-index", {"flop_index": 5.0}))


def test_sample_at_an_angle_without_one_is_refused() -> None:
    step = make_step("set-sample", {"angle_deg": 25.0, "L": 40.0})

    with pytest.raises(DesignError, match="angle_deg is one of 15, 45, 110"):
        make_design().apply(step)


def test_paint_of_another_observer_is_refused() -> None:
    samples = make_spec(RED).samples
    paint = ColorSpec(name="old", samples=samples, observer="2")

    with pytest.raises(DesignError, match="convert the paint first"):
        make_design().apply(make_step("towards", {"paint": paint, "amount": 0.5}))


def test_paint_is_never_extrapolated() -> None:
    samples = tuple(Sample(angle, Lab(50, 0, 0)) for angle in (25.0, 45.0, 75.0))
    paint = ColorSpec(name="old", samples=samples)

    with pytest.raises(DesignError, match="old has no Lab at 15 degrees"):
        make_design().apply(make_step("towards", {"paint": paint, "amount": 0.5}))
