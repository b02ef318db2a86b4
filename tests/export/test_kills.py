"""The exporter killed at its system calls while a consumer snatches the files.

strace counts calls per system call and per thread, so each call is swept alone.
"""

from __future__ import annotations

import re
import shutil
from collections import Counter
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest

from tests.export.exporter import READINGS
from tests.export.exporting import (
    Consumer,
    Place,
    calls_of_the_work,
    number_of_calls,
    traced,
)

CALLS = [
    "fdatasync", "fsync", "ftruncate", "link", "linkat", "mkdir", "mkdirat", "openat",
    "pwrite64", "rename", "renameat", "renameat2", "unlink", "unlinkat", "write",
]  # fmt: skip
NO_NOREPLACE = "renameat2:error=EINVAL"

pytestmark = pytest.mark.skipif(
    shutil.which("strace") is None, reason="strace is not installed"
)


def killed_and_recovered(
    root: Path, call: str, at: int, protocol: str = "token"
) -> tuple[bool, Consumer]:
    """Whether the kill hit, and what the consumer got in the end."""
    place = Place(root, protocol)
    hit = place.export(*traced(call, f"{call}:signal=KILL:when={at}")) != 0
    if hit:
        assert place.export() == 0, f"recovery failed after {call} {at}"
    return hit, place.consumer


def sweep(call: str, tmp_path: Path, protocol: str = "token") -> Iterator[Consumer]:
    """The consumer after a kill at each use of a system call and after no kill."""
    first = number_of_calls(call, tmp_path / "idle", "idle") + 1
    for at in count(first):
        hit, consumer = killed_and_recovered(tmp_path / str(at), call, at, protocol)
        yield consumer
        if not hit:
            return


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


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize("call", CALLS)
def test_no_kill_point_loses_doubles_or_tears(tmp_path: Path, call: str) -> None:
    points = 0
    for consumer in sweep(call, tmp_path):
        points += 1
        assert (consumer.lost(), consumer.doubled(), consumer.torn) == ([], [], [])

    print(f"{call}: {points} runs, the last one without a kill")  # noqa: T201
    assert points >= 1


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("fsync", "EIO"),
        ("mkdirat", "ENOSPC"),
        ("openat", "EACCES"),
        ("renameat2", "EIO"),
        ("unlinkat", "EACCES"),
        ("write", "ENOSPC"),
    ],
)
def test_no_error_loses_doubles_or_tears(tmp_path: Path, call: str, error: str) -> None:
    points = calls_of_the_work(call, tmp_path)
    for at in points:
        place = Place(tmp_path / str(at))

        place.export(*traced(call, f"{call}:error={error}:when={at}"))
        recovered = place.export()

        consumer = place.consumer
        assert recovered == 0
        assert (consumer.lost(), consumer.doubled(), consumer.torn) == ([], [], [])
    assert len(points) >= 1


@pytest.mark.proof
@pytest.mark.timeout(900)
@pytest.mark.parametrize(
    ("protocol", "call", "damage"),
    [
        ("mark-after", "pwrite64", "doubled"),
        ("mark-before", "renameat2", "lost"),
        ("in-place", "write", "torn"),
    ],
)
def test_the_sweep_notices_wrong_protocols(
    tmp_path: Path, protocol: str, call: str, damage: str
) -> None:
    seen = {"doubled": 0, "lost": 0, "torn": 0}
    for consumer in sweep(call, tmp_path, protocol):
        seen["doubled"] += len(consumer.doubled())
        seen["lost"] += len(consumer.lost())
        seen["torn"] += len(consumer.torn)

    assert seen[damage] > 0
