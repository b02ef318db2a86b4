"""The power cut at any instant, journal and folder on disks of their own (P2)."""

from __future__ import annotations

import hashlib
import os
import random
import sqlite3
from collections import Counter
from contextlib import closing
from pathlib import Path

import pytest

from paintlink.daemon.opening import whole
from tests.proofs.disks import Disk, disks
from tests.proofs.stages import READINGS, Stages, reading, warm_up
from tests.proofs.tracing import needs_tracing, traced

pytestmark = [pytest.mark.proof, needs_tracing, pytest.mark.timeout(900)]

STAGES = ("intake", "line", "route")


def all_stages(stages: Stages) -> None:
    for stage in STAGES:
        stages.run(stage)


def shop_on(hot: Disk, state: Disk, scratch: Path, cycle: int) -> Stages:
    """A new shop whose folders had been there long before the power went."""
    folders = [hot.place / str(cycle), state.place / str(cycle)]
    for folder in folders:
        folder.mkdir()
    stages = Stages(scratch / str(cycle), hot=folders[0], state=folders[1])
    stages.journal().close()
    os.sync()
    return stages


def faults(stages: Stages, acknowledged: list[int]) -> Counter[str]:
    """What a power cut must never do, looked at before anything is repaired."""
    found: Counter[str] = Counter()
    path = stages.settings.journal_path
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
        found["damaged"] += whole(connection, path) is not None
        raws = {row[0] for row in connection.execute("SELECT raw FROM readings")}
        rows = connection.execute(
            "SELECT name, sha256, state FROM deliveries"
        ).fetchall()
    found["lost"] += sum(
        reading(number).measurement.raw not in raws for number in acknowledged
    )
    hashes = {name: digest for name, digest, _ in rows}
    for file in stages.hot.glob("*.xml"):
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        found["torn"] += hashes.get(file.name) != digest
    for name, _, state in rows:
        found["marked but missing"] += (
            state == "written" and not (stages.hot / name).exists()
        )
    return +found


def cycle(hot: Disk, state: Disk, scratch: Path, number: int) -> Counter[str]:
    stages = shop_on(hot, state, scratch, number)
    chance = random.Random(number)

    def cut() -> None:
        hot.cut()
        state.cut()

    run = traced(
        lambda: all_stages(stages), kill_at=chance.randrange(1, 330), before_kill=cut
    )
    acknowledged = stages.acknowledged()
    if run.status is not None:
        cut()
    hot.power_on()
    state.power_on()
    found = faults(stages, acknowledged)
    all_stages(stages)
    whole_again = len(list(stages.hot.glob("*.xml")))
    found["not recovered"] += whole_again != READINGS
    return +found


@pytest.mark.parametrize(("kind", "cuts"), [("ext4", 100), ("xfs", 40)])
def test_no_power_cut_loses_tears_or_lies(tmp_path: Path, kind: str, cuts: int) -> None:
    warm_up(Stages(tmp_path / "warm"))
    bad: Counter[str] = Counter()
    with disks(tmp_path, kind, "hot", "state") as (hot, state):
        for number in range(cuts):
            bad += cycle(hot, state, tmp_path / "scratch", number)

    print(f"{kind}: {cuts} power cuts, faults {dict(bad)}")  # noqa: T201
    assert bad == Counter()
