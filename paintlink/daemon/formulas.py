"""The ledger of formulation: answers, sprayed panels, the formula accepted."""

from __future__ import annotations

import sqlite3
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from paintlink.daemon.database import Database
from paintlink.errors import AnswerError, ConfigError
from paintlink.formulation import Answer, Panel, read_answer
from paintlink.model import Sample
from paintlink.spec import read_spec

AnswerState = Literal["open", "accepted", "rejected", "refused", "superseded"]
NOT_SENT = "pending", "publishing", "failed"


@dataclass(frozen=True, slots=True)
class StoredAnswer:
    """An answer as the journal keeps it, with what became of it."""

    id: int
    job_id: int
    iteration: int
    state: AnswerState
    file: str
    received_at: str
    decided_at: str
    answer: Answer


class Formulas:
    """Answers, each stored once, and the panels that were sprayed with them."""

    def __init__(self, database: Database) -> None:
        self._db = database

    def file_name(self, sha256: str) -> str | None:
        """Name under which the same answer was taken before, if it was."""
        row = self._db.one("SELECT file FROM answers WHERE sha256 = ?", sha256)
        return str(row["file"]) if row else None

    def job_of(self, token: str) -> sqlite3.Row:
        """Id and specification of the job that an answer names.

        Raises
        ------
        AnswerError
            When no job of that id was ever sent.
        """
        row = self._db.one("SELECT id, spec FROM jobs WHERE token = ?", token)
        sent = row and self._db.one(
            "SELECT 1 FROM deliveries WHERE job_id = ? AND state NOT IN (?, ?, ?)",
            row["id"],
            *NOT_SENT,
        )
        if row is None or not sent or row["spec"] is None:
            known = "was never sent" if row else "is not known here"
            msg = f"answers job {token}, which {known}: another shop's, or an old one"
            raise AnswerError(msg)
        return row

    def accept(
        self, answer: Answer, *, route: str, file: str, sha256: str, document: bytes
    ) -> StoredAnswer:
        """The answer, stored with everything that changes with it.

        Raises
        ------
        AnswerError
            When it answers what was not asked, or another answer came first.
        """
        job_id = int(self.job_of(answer.job)["id"])
        state: AnswerState = "open" if answer.proposal else "refused"
        with self._db.transaction():
            self._require_asked(job_id, answer)
            self._supersede(job_id, answer)
            answer_id = self._db.insert(
                "answers",
                sha256=sha256,
                file=file,
                job_id=job_id,
                iteration=answer.iteration,
                state=state,
                document=document,
                received_at=self._db.stamp(),
            )
            self._db.run(
                "UPDATE deliveries SET state = 'answered' WHERE job_id = ? "
                "AND route = ? AND state IN ('written', 'stale', 'taken')",
                job_id,
                route,
            )
            self._db.log(
                job_id,
                "answered" if answer.proposal else "refused",
                answer.refusal or _in_words(answer),
                answer=answer_id,
                answer_sha256=sha256,
                iteration=answer.iteration,
            )
        return self._stored(answer_id)

    def of_job(self, job_id: int) -> tuple[StoredAnswer, ...]:
        """The answers to a job, by iteration; those superseded are left out."""
        rows = self._db.all(
            "SELECT * FROM answers WHERE job_id = ? AND state <> 'superseded' "
            "ORDER BY iteration, id",
            job_id,
        )
        return tuple(map(_stored, rows))

    def panels(self, job_id: int) -> tuple[Panel, ...]:
        """The panels sprayed for a job, by iteration."""
        proposals = {
            one.iteration: one.answer.proposal
            for one in self.of_job(job_id)
            if one.answer.proposal
        }
        rows = self._db.all(
            "SELECT iteration, spec FROM jobs WHERE panel_of = ? AND spec IS NOT NULL "
            "ORDER BY iteration, id",
            job_id,
        )
        found = {row["iteration"]: _samples(row["spec"]) for row in rows}
        return tuple(
            Panel(number, proposals[number], samples)
            for number, samples in sorted(found.items())
            if number in proposals
        )

    def open_proposal(self, job_id: int) -> StoredAnswer | None:
        """The newest formula of a job that nobody has decided about."""
        found = [one for one in self.of_job(job_id) if one.state == "open"]
        return found[-1] if found else None

    def link_panel(self, panel_id: int, job_id: int) -> int:
        """Iteration of the formula that a measured panel was sprayed with.

        Raises
        ------
        ConfigError
            When there is no formula that it could have been sprayed with.
        """
        proposal = self.open_proposal(job_id)
        if proposal is None or panel_id == job_id:
            msg = "that job has no open formula: a panel belongs to the newest one"
            raise ConfigError(msg)
        with self._db.transaction():
            self._db.update(
                "jobs", panel_id, panel_of=job_id, iteration=proposal.iteration
            )
            text = f"iteration {proposal.iteration}"
            self._db.log(job_id, "panel", text, panel=panel_id)
            self._db.log(panel_id, "panel", f"{text} of job {job_id}", root=job_id)
        return proposal.iteration

    def decide(
        self, answer: StoredAnswer, state: AnswerState, why: str, **facts: float
    ) -> None:
        """Accept or reject a formula; the reason goes into the history."""
        with self._db.transaction():
            self._db.update(
                "answers", answer.id, state=state, decided_at=self._db.stamp()
            )
            self._db.log(answer.job_id, state, why, answer=answer.id, **facts)

    def ask_again(self, job_id: int, route: str) -> bool:
        """Whether one more file was opened for the route, for the next iteration."""
        with self._db.transaction():
            last = self._db.one(
                "SELECT folder, copy FROM deliveries WHERE job_id = ? AND route = ? "
                "ORDER BY copy DESC LIMIT 1",
                job_id,
                route,
            )
            if last is None:
                return False
            self._db.insert(
                "deliveries",
                job_id=job_id,
                route=route,
                copy=last["copy"] + 1,
                folder=last["folder"],
                state="pending",
                opened_at=self._db.stamp(),
            )
            self._db.update("jobs", job_id, state="matched")
            self._db.log(job_id, "correction", f"asked {route} for a correction")
        return True

    def stop(self, job_id: int, why: str) -> None:
        """Leave a formulation to people; the history says why."""
        with self._db.transaction():
            self._db.log(job_id, "stopped", why)

    def minutes_to_accepted(self, job_id: int) -> float | None:
        """From the first reading of a job to its accepted formula; None before that."""
        row = self._db.one(
            "SELECT coalesce(taken_at, created_at) AS begun, decided_at FROM jobs "
            "JOIN answers ON answers.job_id = jobs.id "
            "LEFT JOIN readings ON readings.id = jobs.reading_id "
            "WHERE jobs.id = ? AND answers.state = 'accepted'",
            job_id,
        )
        if row is None:
            return None
        begun, decided = (datetime.fromisoformat(one) for one in row)
        return (decided - begun).total_seconds() / 60.0

    def formulating(self, limit: int = 50) -> list[str]:
        """Tokens of the jobs with an answer, the newest first."""
        rows = self._db.all(
            "SELECT token, max(answers.id) FROM jobs JOIN answers "
            "ON answers.job_id = jobs.id GROUP BY jobs.id ORDER BY 2 DESC LIMIT ?",
            limit,
        )
        return [str(row["token"]) for row in rows]

    def _require_asked(self, job_id: int, answer: Answer) -> None:
        row = self._db.one("SELECT max(iteration) FROM jobs WHERE panel_of = ?", job_id)
        highest = 0 if row is None or row[0] is None else int(row[0]) + 1
        if answer.iteration > highest:
            msg = (
                f"answers iteration {answer.iteration}, but only {highest} was asked "
                "for: spray and measure a panel first"
            )
            raise AnswerError(msg)

    def _supersede(self, job_id: int, answer: Answer) -> None:
        """A second answer to the same question counts only when it was asked again."""
        first = self._db.one(
            "SELECT * FROM answers WHERE job_id = ? AND iteration = ? "
            "AND state <> 'superseded'",
            job_id,
            answer.iteration,
        )
        if first is None:
            return
        sprayed = self._db.one(
            "SELECT 1 FROM jobs WHERE panel_of = ? AND iteration = ?",
            job_id,
            answer.iteration,
        )
        again = self._db.one(
            "SELECT 1 FROM deliveries WHERE job_id = ? AND opened_at > ?",
            job_id,
            first["received_at"],
        )
        if sprayed or not again or first["state"] == "accepted":
            msg = (
                f"{first['file']} answered iteration {answer.iteration} of job "
                f"{answer.job} before, with something else: reject that formula and "
                "send the job again if this one is right"
            )
            raise AnswerError(msg)
        self._db.update("answers", first["id"], state="superseded")
        self._db.log(job_id, "superseded", first["file"], answer=first["id"])

    def _stored(self, answer_id: int) -> StoredAnswer:
        (row,) = self._db.all("SELECT * FROM answers WHERE id = ?", answer_id)
        return _stored(row)


def _stored(row: sqlite3.Row) -> StoredAnswer:
    names = [name for name in StoredAnswer.__slots__ if name != "answer"]
    answer = read_answer(row["document"], source=row["file"])
    return StoredAnswer(**{name: row[name] for name in names}, answer=answer)


def _samples(document: bytes) -> tuple[Sample, ...]:
    return read_spec(document).samples


def _in_words(answer: Answer) -> str:
    proposal = answer.proposal
    if proposal is None:
        return answer.refusal
    toners = len(proposal.formula.components)
    left = proposal.remaining_dE00
    return f"{answer.program}: {toners} toners, predicted {left:.2f} from the target"
