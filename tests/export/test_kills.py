"""The exporter killed at its system calls while a consumer snatches the files.

The usual tests run it as a program under strace; the proofs sweep every call of a child
that is forked for each point.
"""

from __future__ import annotations

import errno
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.export.exporter import READINGS
from tests.export.exporting import Consumer, Place, traced
from tests.proofs import tracing

NO_NOREPLACE = "renameat2:error=EINVAL"

pytestmark = pytest.mark.skipif(
    shutil.which("strace") is None, reason="strace is not installed"
)


def killed_and_recovered(root: Path, call: str, at: int) -> tuple[bool, Consumer]:
    """Whether the kill hit, and what the consumer got in the end."""
    place = Place(root)
    hit = place.export(*traced(call, f"{call}:signal=KILL:when={at}")) != 0
    if hit:
        assert place.export() == 0, f"recovery failed after {call} {at}"
    return hit, place.consumer


def sweep(root: Path, protocol: str = "token") -> Iterator[tuple[str, Consumer]]:
    """Each call that a kill hit, and what the consumer got in the end."""
    clean = tracing.traced(Place(root / "clean", protocol).work)
    assert clean.status == 0
    for at in range(1, len(clean.calls) + 1):
        place = Place(root / str(at), protocol)
        run = tracing.traced(place.work, kill_at=at, each=place.consumer.take)
        assert run.status is None
        yield run.calls[-1], recovered(place)


def recovered(place: Place) -> Consumer:
    """What the consumer got once the exporter has been started again."""
    place.consumer.take()
    assert tracing.traced(place.work).status == 0
    place.consumer.take()
    return place.consumer


@pytest.mark.parametrize(
    ("call", "at"),
    [("renameat2", 1), ("renameat2", 6), ("mkdirat", 1), ("fsync", 2), ("fsync", 4)],
)
def test_killed_exporter_delivers_each_reading_once(
    tmp_path: Path, call: str, at: int
) -> None:
    hit, consumer = killed_and_recovered(tmp_path / "place", call, at)

    assert hit
    assert consumer.taken == Counter(READINGS)
    assert consumer.torn == []


@pytest.mark.parametrize("at", [1, 4])
def test_file_system_without_noreplace_delivers_once_too(
    tmp_path: Path, at: int
) -> None:
    place = Place(tmp_path / "place")
    kill = f"renameat:signal=KILL:when={at}"

    killed = place.export(*traced("renameat2,renameat", NO_NOREPLACE, kill))
    recovered = place.export(*traced("renameat2", NO_NOREPLACE))

    assert killed != 0
    assert recovered == 0
    assert place.consumer.taken == Counter(READINGS)


def steps_in(folder: Path, log: Path) -> list[str]:
    """What strace saw happen in a folder: renames, and what was synced."""
    steps = []
    for line in log.read_text().splitlines():
        synced = re.search(rf"fsync\(\d+<{re.escape(str(folder))}(.*?)(-\d+)?>", line)
        if synced:
            steps.append(f"fsync {synced[1] or 'folder'}")
        elif f"<{folder}>" in line:
            steps.append("rename")
    return steps


def test_everything_is_synced_before_the_next_step(tmp_path: Path) -> None:
    place = Place(tmp_path / "place")
    log = tmp_path / "calls"

    place.export(*traced("fsync,renameat2", log=str(log)))

    one_delivery = [
        "fsync folder",  # it holds the entry of the staging folder
        "fsync /.paintlink/token",
        "fsync /.paintlink",
        "rename",
        "fsync folder",
        "fsync /.paintlink",
    ]
    assert steps_in(place.folder, log) == one_delivery * len(READINGS)


def test_recovery_syncs_before_it_says_published(tmp_path: Path) -> None:
    place = Place(tmp_path / "place")
    log = tmp_path / "calls"
    after_the_first_rename = "fsync:signal=KILL:when=4"

    killed = place.export(*traced("fsync", after_the_first_rename))
    place.export(*traced("fsync,renameat2", log=str(log)))

    assert killed != 0
    assert steps_in(place.folder, log)[:3] == [
        "fsync folder",
        "fsync /.paintlink",
        "fsync folder",
    ]


@tracing.needs_tracing
@pytest.mark.proof
@pytest.mark.timeout(900)
def test_no_kill_point_loses_doubles_or_tears(memory: Path) -> None:
    points: Counter[str] = Counter()
    for call, consumer in sweep(memory):
        points[call] += 1
        assert (consumer.lost(), consumer.doubled(), consumer.torn) == ([], [], [])

    print(dict(points))  # noqa: T201
    assert points["renameat2"] == len(READINGS)
    assert points["fsync"] == 5 * len(READINGS)
    assert points.total() > 100


@tracing.needs_tracing
@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("fsync", errno.EIO),
        ("mkdirat", errno.ENOSPC),
        ("openat", errno.EACCES),
        ("renameat2", errno.EIO),
        ("unlinkat", errno.EACCES),
        ("write", errno.ENOSPC),
    ],
)
def test_no_error_loses_doubles_or_tears(memory: Path, call: str, error: int) -> None:
    clean = tracing.traced(Place(memory / "clean").work)
    number = clean.calls.count(call)
    for at in range(1, number + 1):
        place = Place(memory / str(at))

        run = tracing.traced(place.work, fail=(call, at, error))

        consumer = recovered(place)
        assert run.status is not None
        assert (consumer.lost(), consumer.doubled(), consumer.torn) == ([], [], [])
    assert number >= 1


@tracing.needs_tracing
@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("protocol", "damage"),
    [("mark-after", "doubled"), ("mark-before", "lost"), ("in-place", "torn")],
)
def test_the_sweep_notices_wrong_protocols(
    memory: Path, protocol: str, damage: str
) -> None:
    for _, consumer in sweep(memory, protocol):
        if {
            "doubled": consumer.doubled(),
            "lost": consumer.lost(),
            "torn": consumer.torn,
        }[damage]:
            return
    pytest.fail(f"no kill shows that {protocol} is wrong")
