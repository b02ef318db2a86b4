"""The formulation loop: answers in, panels judged, corrections asked for."""

from __future__ import annotations

import hashlib
import logging
import re

from paintlink.config import FormulationSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import Job
from paintlink.errors import InputError
from paintlink.formulation import (
    Step,
    best_step,
    convergence,
    mean_error,
    read_answer,
    require_fitting,
)
from paintlink.intake import BusyFileError, Claim, Inbox
from paintlink.spec import read_spec

log = logging.getLogger(__name__)

BUSY_LIMIT_S = 300.0
_TOKEN = re.compile(r"[a-z2-7]{10}")


class AnswerWorker:
    """Takes answers from their folder, each once, and matches them to their jobs.

    Parameters
    ----------
    route
        The route whose program answers.
    """

    def __init__(
        self, journal: Journal, inbox: Inbox, rules: FormulationSettings, route: str
    ) -> None:
        self._journal = journal
        self._inbox = inbox
        self._rules = rules
        self._route = route
        self._trouble = ""

    def step(self) -> bool:
        """Take one answer; False when none is ready."""
        claim = self._claim()
        if claim is None:
            return False
        try:
            self._accept(claim)
        except InputError as error:
            patience_s = BUSY_LIMIT_S if isinstance(error, BusyFileError) else None
            if not self._inbox.postpone(claim.path, patience_s=patience_s):
                log.warning("answers: %s", error)
                self._inbox.finish(claim.path, "failed", str(error))
        return True

    def _claim(self) -> Claim | None:
        try:
            claim = self._inbox.claim()
        except InputError as error:
            if str(error) != self._trouble:
                log.warning("answers: %s", error)
            self._trouble = str(error)
            return None
        self._trouble = ""
        return claim

    def _accept(self, claim: Claim) -> None:
        data = self._inbox.read(claim.path)
        digest = hashlib.sha256(data).hexdigest()
        known = self._journal.formulas.file_name(digest)
        if known is not None and not claim.left_over:
            reason = f"the same answer was taken before as {known}"
            self._inbox.finish(claim.path, "duplicate", reason)
            return
        if known is None:
            self._store(claim.path.name, data, digest)
        self._inbox.finish(claim.path, "done")

    def _store(self, name: str, data: bytes, digest: str) -> None:
        answer = read_answer(data, source=name)
        target = read_spec(self._journal.formulas.job_of(answer.job)["spec"])
        require_fitting(answer, target, toners=self._rules.toners)
        stored = self._journal.formulas.accept(
            answer, route=self._route, file=name, sha256=digest, document=data
        )
        log.info("%s answered, iteration %d", answer.job, stored.iteration)


class Booth:
    """Judges panels: closes a job, asks for a correction, or leaves it to people."""

    def __init__(
        self, journal: Journal, rules: FormulationSettings, route: str
    ) -> None:
        self._journal = journal
        self._rules = rules
        self._route = route

    def panel_of(self, job: Job) -> Job | None:
        """The job whose panel a reading shows: its sample name begins with its id."""
        name = job.spec.name if job.spec else ""
        token = _TOKEN.match(name)
        root = self._journal.job(token[0]) if token else None
        if root is None or root.id == job.id or root.panel_of is not None:
            return None
        return root if self._journal.formulas.open_proposal(root.id) else None

    def judge(self, panel: Job, root: Job) -> None:
        """Link a measured panel to its formula and do what follows from it."""
        with self._journal.transaction():
            iteration = self._journal.formulas.link_panel(panel.id, root.id)
            best = best_step(self.steps(root))
            if root.spec is None or panel.spec is None or best is None:
                return
            error = mean_error(root.spec, panel.spec.samples)
            text = f"panel {iteration}: {error:.2f} from the target"
            self._journal.finish(panel, f"{text} of job {root.token}")
            if (best.measured_mean or 0.0) <= self._rules.accept_dE00:
                self._close(root, best)
            else:
                self._go_on(root, iteration, text)

    def _go_on(self, root: Job, iteration: int, text: str) -> None:
        formulas = self._journal.formulas
        if iteration + 1 >= self._rules.panels:
            why = f"{text}; {iteration + 1} panels are the limit, a person decides"
            formulas.stop(root.id, why)
        elif not formulas.ask_again(root.id, self._route):
            formulas.stop(root.id, f"{text}; no route asks for corrections")

    def steps(self, root: Job) -> tuple[Step, ...]:
        """How the formulation of a job converges."""
        if root.spec is None:
            return ()
        answers = self._journal.formulas.of_job(root.id)
        proposals = [
            (one.iteration, one.answer.proposal)
            for one in answers
            if one.answer.proposal
        ]
        panels = self._journal.formulas.panels(root.id)
        return convergence(root.spec, proposals, panels)

    def _close(self, root: Job, best: Step) -> None:
        for one in self._journal.formulas.of_job(root.id):
            if one.iteration == best.iteration and one.state == "open":
                mean = best.measured_mean or 0.0
                why = f"panel {best.iteration} is {mean:.2f} from the target"
                self._journal.formulas.decide(one, "accepted", why, dE00=round(mean, 4))
