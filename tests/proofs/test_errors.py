"""Full, failing, read-only and hung disks: nothing acknowledged is lost (P5)."""

from __future__ import annotations

import errno
import os
import shutil
from collections import Counter
from pathlib import Path

import pytest

from paintlink.errors import JournalError, JournalFullError
from tests.proofs.stages import READINGS, Stages, reading, warm_up
from tests.proofs.test_kills import copied, faults, finish, prepared
from tests.proofs.tracing import needs_tracing, traced

pytestmark = [needs_tracing, pytest.mark.timeout(600)]

ERRORS = (errno.ENOSPC, errno.EIO, errno.EROFS, errno.EACCES)
CALLS = ("write", "fsync", "renameat2", "openat", "mkdirat")
JOURNAL_CALLS = ("pwrite64", "fdatasync", "ftruncate", "openat")


@pytest.fixture(scope="module", autouse=True)
def warm(tmp_path_factory: pytest.TempPathFactory) -> None:
    warm_up(Stages(tmp_path_factory.mktemp("warm")))


def repaired(stages: Stages) -> None:
    """Everything again, later: a postponed delivery is due within five seconds."""
    with stages.journal() as journal, journal.transaction():
        row = journal._db.one("SELECT max(retry_at) FROM deliveries")
        assert row is not None
        assert (row[0] or 0.0) <= 1_800_000_005.0
        journal._db.run("UPDATE deliveries SET retry_at = 0")
    finish(stages)


def failed_at(
    stage: str, root: Path, calls: tuple[str, ...], every: int = 1
) -> tuple[int, Counter[str]]:
    template = prepared(root / "template", stage)
    clean = Counter(traced(copied(template.root, root / "clean").work(stage)).calls)
    points, bad = 0, Counter[str]()
    cases = [
        (call, at, code) for call in calls for at in range(1, clean[call] + 1)
        for code in ERRORS
    ]  # fmt: skip
    for call, at, code in cases[::every]:
        stages = copied(template.root, root / "at")
        run = traced(stages.work(stage), fail=(call, at, code))
        assert run.status is not None, f"{stage} hung at {call} {at}"
        acknowledged = stages.acknowledged()
        repaired(stages)
        points += 1
        bad += faults(stages, acknowledged)
        with stages.journal() as journal:
            states = {one.state for job in journal.jobs() for one in job.deliveries}
        bad["stuck"] += not states <= {"written", "taken", "answered"}
        shutil.rmtree(stages.root)
    return points, +bad


def test_some_errors_of_the_folder_lose_nothing(tmp_path: Path) -> None:
    points, bad = failed_at("route", tmp_path, CALLS, every=17)

    assert points >= 5
    assert bad == Counter()


@pytest.mark.proof
@pytest.mark.parametrize(
    ("stage", "calls", "least"), [("route", CALLS, 150), ("intake", JOURNAL_CALLS, 40)]
)
def test_no_error_loses_doubles_or_sticks(
    memory: Path, stage: str, calls: tuple[str, ...], least: int
) -> None:
    points, bad = failed_at(stage, memory, calls)

    print(f"{stage}: {points} errors, faults {dict(bad)}")  # noqa: T201
    assert points >= least
    assert bad == Counter()


def intake(stages: Stages) -> None:
    try:
        stages.run("intake")
    except JournalFullError:
        os._exit(41)
    except JournalError:
        os._exit(42)


@pytest.mark.parametrize("at", [1, 3, 4])
def test_failed_sync_of_the_journal_is_never_acknowledged_or_retried(
    memory: Path, at: int
) -> None:
    stages = Stages(memory / "shop")
    stages.journal().close()

    run = traced(lambda: intake(stages), fail=("fdatasync", at, errno.EIO))

    assert run.status == 42
    synced = run.calls.count("fdatasync")
    acknowledged = stages.acknowledged()
    with stages.journal() as journal:
        raws = {journal.reading(job.reading_id or 0).measurement.raw
                for job in journal.jobs()}  # fmt: skip
    assert synced <= at + 2  # closing syncs what had been committed before
    assert len(acknowledged) < READINGS
    assert {reading(number).measurement.raw for number in acknowledged} <= raws


def test_full_state_disk_is_not_acknowledged_and_heals(memory: Path) -> None:
    stages = Stages(memory / "template")
    stages.journal().close()
    writes = traced(copied(stages.root, memory / "clean").work("intake")).calls
    ended: Counter[int | None] = Counter()
    for at in range(1, writes.count("pwrite64") + 1, 5):
        shop = copied(stages.root, memory / str(at))
        fail = ("pwrite64", at, errno.ENOSPC)
        run = traced(lambda: intake(shop), fail=fail)  # noqa: B023
        ended[run.status] += 1
        acknowledged = shop.acknowledged()
        with shop.journal() as journal:
            assert len(journal.jobs()) >= len(acknowledged)
        shop.run("intake")
        with shop.journal() as journal:
            assert len(journal.jobs()) == READINGS

    assert ended[41] > 0
    assert set(ended) <= {0, 41, 42}
