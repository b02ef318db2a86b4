"""The formulation loop: answers in, panels judged, corrections asked for."""

from __future__ import annotations

import logging
import re

from paintlink.config import FormulationSettings
from paintlink.daemon.folder_worker import FolderWorker
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import Job
from paintlink.formulation import (
    Step,
    best_step,
    convergence,
    mean_error,
    read_answer,
    require_fitting,
)
from paintlink.intake import Claim, Inbox
from paintlink.spec import read_spec

log = logging.getLogger(__name__)

_TOKEN = re.compile(r"[a-z2-7]{10}")


class AnswerWorker(FolderWorker):
    """Takes answers, each once, and matches them to their jobs.

    Parameters
    ----------
    route
        The route whose program answers.
    """

    def __init__(
        self, journal: Journal, inbox: Inbox, rules: FormulationSettings, route: str
    ) -> None:
        super().__init__(inbox)
        self._formulas = journal.formulas
        self._rules = rules
        self._route = route

    def _known(self, digest: str) -> str | None:
        return self._formulas.file_name(digest)

    def _store(self, claim: Claim, data: bytes, digest: str) -> str:
        name = claim.path.name
        answer = read_answer(data, source=name)
        target = read_spec(self._formulas.job_of(answer.job)["spec"])
        require_fitting(answer, target, toners=self._rules.toners)
        stored = self._formulas.accept(
            answer, route=self._route, file=name, sha256=digest, document=data
        )
        log.info("%s answered, iteration %d", answer.job, stored.iteration)
        return ""


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
