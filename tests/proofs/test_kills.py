"""Killed at every system call of every thread (P1, P3, P4).

Each thread of the service is run alone in a child, because a count over several threads
would hit the rare calls of one only by accident. The table at the end names every call
of every thread and how many points it had.
"""

from __future__ import annotations

import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.formulation import write_answer
from tests.formulation.test_answer import make_answer
from tests.proofs.stages import READINGS, Stages, reading, warm_up
from tests.proofs.tracing import needs_tracing, traced

pytestmark = [needs_tracing, pytest.mark.timeout(600)]

BEFORE = {"intake": (), "inbox": (), "line": ("intake", "inbox"),
          "route": ("intake", "inbox", "line"),
          "answers": ("intake", "inbox", "line", "route")}  # fmt: skip


@pytest.fixture(scope="module", autouse=True)
def warm(tmp_path_factory: pytest.TempPathFactory) -> None:
    warm_up(Stages(tmp_path_factory.mktemp("warm")))


def prepared(root: Path, stage: str) -> Stages:
    """A shop in which everything before a stage is done."""
    stages = Stages(root)
    if "inbox" in (*BEFORE[stage], stage):
        stages.drop_files()
    for earlier in BEFORE[stage]:
        stages.run(earlier)
    if stage == "answers":
        drop_answers(stages)
    return stages


def drop_answers(stages: Stages) -> None:
    """An answer to every job that was delivered, as formulation software writes it."""
    proposal = make_answer().proposal
    assert proposal is not None
    with stages.journal() as journal:
        for job in journal.jobs():
            assert job.spec is not None
            assert job.spec.starting_paint is not None
            exact = replace(proposal, predicted=job.spec.samples, remaining_dE00=0.0)
            answer = replace(
                make_answer(),
                job=job.token,
                starting_paint=job.spec.starting_paint.code,
                proposal=exact,
            )
            path = stages.root / "answers" / f"{job.token}.xml"
            path.write_bytes(write_answer(answer))


def finish(stages: Stages) -> None:
    """Start everything again, until nothing is left to do, the consumer snatching."""
    for stage in ("intake", "inbox", "line", "route", "answers"):
        stages.run(stage)
        stages.consumer.take()


def faults(stages: Stages, acknowledged: list[int]) -> Counter[str]:
    """What must never be: lost, doubled, torn, or marked and missing."""
    found: Counter[str] = Counter()
    with stages.journal() as journal:
        jobs = journal.jobs(limit=100)
        sources = Counter(job.source for job in jobs)
        stored = [
            journal.reading(job.reading_id).measurement.raw
            for job in jobs
            if job.reading_id is not None
        ]
        for number in acknowledged:
            found["lost"] += reading(number).measurement.raw not in stored
        found["doubled"] += len(stored) - len(set(stored))
        found["doubled"] += sum(sources[f"{n}.xml"] > 1 for n in range(READINGS))
        written = {f"{job.token}-1" for job in jobs for one in job.deliveries
                   if one.state in {"written", "taken", "answered"}}  # fmt: skip
        found["marked but missing"] += len(written - set(stages.consumer.seen))
        found["unexplained"] += len(list(journal.trail.faults()))
        found["unanswered"] += sum(
            len(journal.formulas.of_job(job.id)) > 1 for job in jobs
        )
    found["doubled"] += len(stages.consumer.doubled())
    found["torn"] += len(stages.consumer.torn)
    return +found


def sweep(stage: str, root: Path, every: int = 1) -> tuple[Counter[str], Counter[str]]:
    """Points by call, and the faults, of a stage killed at each of its calls."""
    template = prepared(root / "template", stage)
    clean = traced(copied(template.root, root / "clean").work(stage))
    assert clean.status == 0
    points: Counter[str] = Counter()
    bad: Counter[str] = Counter()
    for at in range(1, len(clean.calls) + 1, every):
        stages = copied(template.root, root / "at")
        run = traced(stages.work(stage), kill_at=at, each=stages.consumer.take)
        acknowledged = stages.acknowledged()
        stages.consumer.take()
        finish(stages)
        points[run.calls[-1]] += run.status is None
        bad += faults(stages, acknowledged)
        shutil.rmtree(stages.root)
    return points, bad


def copied(template: Path, target: Path) -> Stages:
    shutil.copytree(template, target)
    return rerooted(target)


def rerooted(root: Path) -> Stages:
    """The copy of a shop: its journal names the folder of the template."""
    stages = Stages(root)
    with stages.journal() as journal, journal.transaction():
        journal._db.run("UPDATE deliveries SET folder = ?", str(stages.hot))
    return stages


@pytest.mark.parametrize("stage", ["intake", "route"])
def test_some_kills_lose_and_double_nothing(tmp_path: Path, stage: str) -> None:
    points, bad = sweep(stage, tmp_path, every=13)

    assert points.total() >= 3
    assert bad == Counter()


@pytest.mark.proof
@pytest.mark.parametrize("stage", list(BEFORE))
def test_no_kill_point_of_a_thread_loses_or_doubles(memory: Path, stage: str) -> None:
    points, bad = sweep(stage, memory)

    for call, number in sorted(points.items()):
        print(f"{stage:8} {call:16} {number:4} points")  # noqa: T201
    assert bad == Counter()
    assert points.total() > 40
    if stage == "route":
        assert points["renameat2"] == 2 * READINGS
        assert points["fsync"] >= 2 * READINGS + 4
