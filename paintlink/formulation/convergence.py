"""How a formulation comes nearer to its target, iteration by iteration."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from paintlink.formulation.judging import AngleError, errors_per_angle
from paintlink.formulation.values import Panel, Proposal
from paintlink.model import ColorSpec


class Step(NamedTuple):
    """One iteration: what was predicted, what the panel came to, the best so far.

    Means of CIEDE2000 over the angles; None where there is no panel yet.
    """

    iteration: int
    proposal: Proposal
    predicted: tuple[AngleError, ...]
    measured: tuple[AngleError, ...]
    predicted_mean: float
    measured_mean: float | None
    best_mean: float | None


def convergence(
    target: ColorSpec,
    proposals: Sequence[tuple[int, Proposal]],
    panels: Sequence[Panel],
) -> tuple[Step, ...]:
    """The steps of a job, oldest first; the last panel of an iteration counts."""
    measured = {panel.iteration: panel.measured for panel in panels}
    steps: list[Step] = []
    best: float | None = None
    for iteration, proposal in proposals:
        predicted = errors_per_angle(target, proposal.predicted)
        found = errors_per_angle(target, measured.get(iteration, ()))
        mean = _mean(found)
        best = min((one for one in (best, mean) if one is not None), default=None)
        steps.append(
            Step(
                iteration,
                proposal,
                predicted,
                found,
                _mean(predicted) or 0.0,
                mean,
                best,
            )
        )
    return tuple(steps)


def best_step(steps: Sequence[Step]) -> Step | None:
    """The step whose panel came nearest; None before the first panel."""
    sprayed = [step for step in steps if step.measured_mean is not None]
    return min(sprayed, key=lambda step: step.measured_mean or 0.0, default=None)


def _mean(errors: Sequence[AngleError]) -> float | None:
    return sum(one.dE00 for one in errors) / len(errors) if errors else None
