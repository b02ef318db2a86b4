"""The stand-in as a program: watches its folder, takes job files, writes answers.

It knows nothing of paintlink but the two documents in docs/formats.md.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Protocol

from paintlink.errors import InputError
from paintlink_simulators.colornet.answerfile import formula_answer, refusal_answer
from paintlink_simulators.colornet.correction import best_attempt, correct
from paintlink_simulators.colornet.formulation import (
    CLOSE_DE00,
    MOST_TONERS,
    Formulation,
    formulate,
)
from paintlink_simulators.colornet.jobfile import ColorNetJob, read_job
from paintlink_simulators.colornet.target import Target
from paintlink_simulators.paint import Formula


class Book(Protocol):
    """Known formulas, as formulation software has them."""

    def starts(self, code: str, target: Target) -> Sequence[Formula]:
        """The formula of a paint, then those of the paints nearest to the target."""


class Watch:
    """Answers the job files that appear in a folder, one a step.

    Parameters
    ----------
    hot
        The folder where job files appear; it is emptied.
    taken
        Where they are kept; on the same disk as ``hot``, or its share.
    answers
        The folder where answers are expected.
    """

    def __init__(
        self,
        hot: Path,
        taken: Path,
        answers: Path,
        book: Book,
        *,
        now: Callable[[], datetime] = lambda: datetime.now(UTC),
    ) -> None:
        self._hot, self._taken, self._answers = hot, taken, answers
        self._book = book
        self._now = now

    def step(self) -> Path | None:
        """The answer to the oldest job file; None when none lies there."""
        waiting = [one for one in self._hot.glob("*.xml") if one.name[0] != "."]
        for path in sorted(waiting, key=lambda one: one.stat().st_mtime_ns):
            kept = self._taken / path.name
            try:
                path.rename(kept)
            except OSError:
                continue  # gone, or another program holds it open: the next round
            return self._answer(kept)
        return None

    def _answer(self, kept: Path) -> Path:
        job = read_job(kept.read_bytes(), kept.name)
        try:
            data = formula_answer(job, self._found(job), self._now())
        except InputError as refusal:
            data = refusal_answer(job, str(refusal), self._now())
        return self._write(f"{job.id}-{job.iteration}-{kept.stem[-8:]}.xml", data)

    def _found(self, job: ColorNetJob) -> Formulation:
        if job.attempts:
            return self._corrected(job)
        found = formulate(job.target, self._book.starts(job.starting_paint, job.target))
        if found.mean_difference > CLOSE_DE00:
            worst = int(found.difference.argmax())
            angle = job.target.aspecular_deg[worst]
            msg = (
                f"no formula within {MOST_TONERS} toners: "
                f"{found.difference[worst]:.1f} remain at {angle:g} degrees"
            )
            raise InputError(msg)
        return found

    def _corrected(self, job: ColorNetJob) -> Formulation:
        found = correct(job.target, job.attempts)
        best = best_attempt(job.target, job.attempts)
        if found.parts == best.parts:
            left = float(job.target.mean_difference(best.measured))
            msg = (
                f"no correction is better than the best panel, {left:.2f} from the "
                "target: spray it again, or start from another paint"
            )
            raise InputError(msg)
        return found

    def _write(self, name: str, data: bytes) -> Path:
        """An answer appears whole: it is written beside and renamed."""
        partial = self._answers / f".{name}.part"
        with partial.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        return partial.rename(self._answers / name)
