"""Convergence of a formulation over its panels."""

from __future__ import annotations

from dataclasses import replace

import pytest

from paintlink.formulation import (
    Panel,
    best_step,
    convergence,
    errors_per_angle,
    mean_error,
)
from paintlink.model import Sample
from tests.formulation.test_answer import make_answer, make_target


def shifted(by: float) -> tuple[Sample, ...]:
    return tuple(
        replace(one, lab=one.lab._replace(a=one.lab.a + by))
        for one in make_target().samples
    )


def test_errors_stand_at_the_common_angles_only() -> None:
    errors = errors_per_angle(make_target(), shifted(1.0)[:2])

    assert [one.aspecular_deg for one in errors] == [15.0, 45.0]
    assert all(one.dE00 > 0.5 for one in errors)


def test_best_panel_is_kept_when_a_later_one_is_worse() -> None:
    target, proposal = make_target(), make_answer().proposal
    assert proposal is not None
    panels = [
        Panel(number, proposal, shifted(by))
        for number, by in ((0, 2.0), (1, 0.5), (2, 1.0))
    ]

    steps = convergence(target, [(number, proposal) for number in range(4)], panels)

    means = [mean_error(target, panel.measured) for panel in panels]
    assert [step.measured_mean for step in steps] == pytest.approx([*means, None])
    assert [step.best_mean for step in steps] == pytest.approx([
        means[0],
        means[1],
        means[1],
        means[1],
    ])
    best = best_step(steps)
    assert best is not None
    assert best.iteration == 1


def test_nothing_sprayed_has_no_best_step() -> None:
    proposal = make_answer().proposal
    assert proposal is not None

    assert best_step(convergence(make_target(), [(0, proposal)], [])) is None
