"""How far a colour is from its target, and whether an answer fits its job."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np

from paintlink.color import ciede2000
from paintlink.errors import AnswerError
from paintlink.formulation.values import Answer, Proposal
from paintlink.model import ColorSpec, Sample

STATED_TOLERANCE_DE00 = 0.2  # rounding, and programs that weigh angles otherwise


class AngleError(NamedTuple):
    """CIEDE2000 between target and colour at one aspecular angle."""

    aspecular_deg: float
    dE00: float


def errors_per_angle(
    target: ColorSpec, colour: Sequence[Sample]
) -> tuple[AngleError, ...]:
    """The difference at each angle that both were given at, ascending."""
    labs = {one.aspecular_deg: one.lab for one in colour}
    common = [angle for angle in target.angles_deg if angle in labs]
    if not common:
        return ()
    found = ciede2000(target.lab(*common), np.array([labs[angle] for angle in common]))
    return tuple(map(AngleError, common, found.tolist()))


def mean_error(target: ColorSpec, colour: Sequence[Sample]) -> float:
    """Mean CIEDE2000 over the common angles; NaN without any."""
    found = [one.dE00 for one in errors_per_angle(target, colour)]
    return sum(found) / len(found) if found else float("nan")


def require_fitting(
    answer: Answer, target: ColorSpec, *, toners: Collection[str] = ()
) -> None:
    """Refuse an answer that contradicts the job it names.

    Parameters
    ----------
    toners
        The toners there are; none means that they are not known.

    Raises
    ------
    AnswerError
        Naming what differs, for the file's reason.
    """
    start = target.starting_paint.code if target.starting_paint else ""
    if answer.starting_paint != start:
        msg = (
            f"starts from {answer.starting_paint}, the job from {start}: this answers "
            "another job"
        )
        raise AnswerError(msg)
    if answer.proposal is not None:
        _require_same_conditions(answer.proposal, target)
        _require_known(answer.proposal, toners)
        _require_true_remainder(answer.proposal, target)


def _require_same_conditions(proposal: Proposal, target: ColorSpec) -> None:
    if proposal.observer != target.observer:
        msg = (
            f"predicted for the {proposal.observer} degree observer, the job asked for "
            f"{target.observer}: calculate it again"
        )
        raise AnswerError(msg)
    predicted = {one.aspecular_deg for one in proposal.predicted}
    missing = [angle for angle in target.angles_deg if angle not in predicted]
    if missing:
        angles = "/".join(f"{angle:g}" for angle in missing)
        msg = f"no predicted colour at {angles} degrees, which the job asked for"
        raise AnswerError(msg)


def _require_known(proposal: Proposal, toners: Collection[str]) -> None:
    unknown = [
        name for name in proposal.formula.toners if toners and name not in toners
    ]
    if unknown:
        msg = (
            f"toner {', '.join(unknown)} is not on the list of this shop: correct the "
            "formulation software's system, or [formulation] toners"
        )
        raise AnswerError(msg)


def _require_true_remainder(proposal: Proposal, target: ColorSpec) -> None:
    found = mean_error(target, proposal.predicted)
    if abs(found - proposal.remaining_dE00) > STATED_TOLERANCE_DE00:
        msg = (
            f"states a remaining difference of {proposal.remaining_dE00:.2f}, but its "
            f"predicted colour is {found:.2f} from the job's target"
        )
        raise AnswerError(msg)
