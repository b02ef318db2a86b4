"""The whole service killed at random, under a stream of readings and files (P1, P3).

The sweeps of `test_kills` stop one thread at a time. Here all threads run, and what
meets when they are killed together is left to chance; the seed is in the output.
"""

from __future__ import annotations

import ctypes
import os
import random
import signal
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest

from paintlink.config import InboxSettings, Settings
from paintlink.daemon.journal import Journal
from paintlink.daemon.service import Service
from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec
from tests.proofs.stages import Stages, reading, warm_up

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="a child that dies with us"),
    pytest.mark.timeout(900),
]

LIMIT_S = 60.0
PAUSE_S = 0.003
LONGEST_LIFE_S = 0.25
DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG


@dataclass
class Shop:
    """Folders, a consumer that snatches, and what was acknowledged or dropped."""

    stages: Stages
    settings: Settings = field(init=False)
    dropped: int = 0

    def __post_init__(self) -> None:
        inbox = InboxSettings(
            folder=self.stages.root / "inbox", poll_s=0.1, quiet_s=0.05
        )
        self.settings = replace(self.stages.settings, inbox=inbox)

    @property
    def acks(self) -> Path:
        return self.stages.root / "acknowledged"

    def acknowledged(self) -> list[int]:
        """Numbers that were acknowledged; a torn last line was not."""
        if not self.acks.exists():
            return []
        return [int(line) for line in self.acks.read_text().split("\n")[:-1]]

    def drop(self) -> None:
        """One more file of another program, renamed into the inbox whole."""
        data = write_spec(make_spec(f"file {self.dropped}"))
        part = self.stages.root / "inbox" / f".{self.dropped}.part"
        part.write_bytes(data)
        part.rename(part.with_name(f"{self.dropped}.xml"))
        self.dropped += 1

    def serve(self) -> None:
        """The service, with an instrument that never stops."""
        service = Service(self.settings, roles=("intake", "line"))
        service.start()
        descriptor = os.open(self.acks, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
        number = max(self.acknowledged(), default=-1) + 1
        with Journal(self.settings.journal_path) as journal:
            while True:
                # One that was stored but not acknowledged is sent again, as devices do.
                journal.accept_reading(reading(number), source="bench")
                os.write(descriptor, b"%d\n" % number)
                service.wake()
                number += 1
                time.sleep(PAUSE_S)

    def finish(self) -> None:
        """The service without new readings, until nothing is left to do."""
        service = Service(self.settings, roles=("intake", "line"))
        service.start()
        while self.left():
            time.sleep(0.05)
        service.stop()

    def left(self) -> bool:
        waiting = self.stages.root / "inbox", self.stages.root / "working"
        if any(path for folder in waiting for path in folder.glob("*.xml")):
            return True
        with Journal(self.settings.journal_path) as journal:
            return set(journal.counts()) != {"done"}


def forked(work: Callable[[], None]) -> int:
    """Process id of a child that does some work, and nothing of the test's."""
    child = os.fork()
    if child:
        return child
    code = 70
    try:
        ctypes.CDLL(None).prctl(DIE_WITH_PARENT, signal.SIGKILL)
        work()
        code = 0
    finally:
        os._exit(code)


def until(condition: Callable[[], bool]) -> Iterator[None]:
    """Rounds until the condition comes true."""
    deadline = time.monotonic() + LIMIT_S
    while not condition():
        assert time.monotonic() < deadline, "the service makes no progress"
        yield
        time.sleep(PAUSE_S)


def lived(shop: Shop, life_s: float, *, from_start: bool) -> None:
    """One life of the service, killed after its start or after its first reading."""
    size = shop.acks.stat().st_size if shop.acks.exists() else 0
    child = forked(shop.serve)
    try:
        if not from_start:
            for _ in until(
                lambda: shop.acks.exists() and shop.acks.stat().st_size > size
            ):
                shop.stages.consumer.take()
        shop.drop()
        end = time.monotonic() + life_s
        for _ in until(lambda: time.monotonic() > end):
            shop.stages.consumer.take()
        assert os.waitpid(child, os.WNOHANG) == (0, 0), "the service ended by itself"
    finally:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


def drained(shop: Shop) -> None:
    """The last life of the service, which may end."""
    child, ended = forked(shop.finish), [(0, 0)]

    def has_ended() -> bool:
        ended[0] = os.waitpid(child, os.WNOHANG)
        return ended[0][0] != 0

    for _ in until(has_ended):
        shop.stages.consumer.take()
    assert ended[0] == (child, 0)
    shop.stages.consumer.take()


def lost(shop: Shop) -> set[bytes]:
    """Raw bytes of acknowledged readings that the journal does not hold."""
    told = {reading(number).measurement.raw for number in shop.acknowledged()}
    with Journal(shop.settings.journal_path) as journal:
        return told - {
            row["raw"] for row in journal._db.all("SELECT raw FROM readings")
        }


@pytest.mark.parametrize(
    "kills", [3, pytest.param(100, marks=pytest.mark.proof)], ids="{} kills".format
)
def test_random_kills_under_load_lose_and_double_nothing(
    tmp_path: Path, kills: int
) -> None:
    warm_up(Stages(tmp_path / "warm"))
    seed = int(os.environ.get("PAINTLINK_TEST_SEED", time.time_ns() % 1_000_000))
    print(f"PAINTLINK_TEST_SEED={seed}")  # noqa: T201
    chance = random.Random(seed)
    shop = Shop(Stages(tmp_path / "shop"))

    for number in range(kills):
        lived(
            shop,
            chance.uniform(0.0, LONGEST_LIFE_S),
            from_start=number % 3 == 2,
        )
        assert lost(shop) == set()
        assert shop.stages.consumer.doubled() == []
    drained(shop)

    check(shop)
    print(  # noqa: T201
        f"{kills} kills, {len(shop.acknowledged())} readings, {shop.dropped} files"
    )


def check(shop: Shop) -> None:
    """Everything acknowledged or dropped was delivered once, and is explained."""
    consumer = shop.stages.consumer
    with Journal(shop.settings.journal_path) as journal:
        jobs = journal.jobs(limit=1_000_000)
        assert list(journal.trail.faults()) == []
    sources = [job.source for job in jobs if job.reading_id is None]
    assert {f"{job.token}-1" for job in jobs} == set(consumer.seen)
    assert (consumer.doubled(), consumer.torn) == ([], [])
    assert len(jobs) - len(sources) >= len(shop.acknowledged())
    assert sorted(sources) == sorted(f"{n}.xml" for n in range(shop.dropped))
