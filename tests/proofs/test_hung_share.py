"""A share whose server is gone for half a minute: intake goes on (P5)."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from paintlink.config import RouteSettings, Settings
from paintlink.daemon.health import health
from paintlink.daemon.journal import Journal
from paintlink.daemon.service import Service
from tests.proofs.hanging_share import mounted
from tests.proofs.stages import Consumer, Stages, reading

pytestmark = [pytest.mark.proof, pytest.mark.timeout(300)]

HUNG_S = 30.0
LIMIT_S = 60.0


def wait_for(condition: Callable[[], bool]) -> float:
    """Seconds until the condition came true."""
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < LIMIT_S, "waited for a minute"
        time.sleep(0.05)
    return time.monotonic() - begun


def with_archive(told: Settings, folder: Path) -> Settings:
    folder.mkdir()
    archive = RouteSettings(name="archive", folder=folder, format="json")
    return replace(told, routes=(*told.routes, archive))


def test_hung_share_loses_nothing_and_drains(tmp_path: Path) -> None:
    with mounted(tmp_path / "share") as (share, hang):
        stages = Stages(tmp_path / "shop", hot=share)
        told = with_archive(stages.settings, tmp_path / "archive")
        service = Service(told, roles=("line",))
        service.start()
        try:
            through_a_hang(service, told, hang)
        finally:
            hang.unlink(missing_ok=True)
            service.stop()


def through_a_hang(service: Service, told: Settings, hang: Path) -> None:
    consumer = Consumer(told.routes[0].folder)
    with Journal(told.journal_path) as journal:

        def light() -> str:
            return health(journal, told.routes[:1], datetime.now(UTC))[0].light

        def states(route: str) -> list[str]:
            jobs = journal.jobs(limit=1000)
            found = [
                one for job in jobs for one in job.deliveries if one.route == route
            ]
            return [one.state for one in found]

        accept(service, journal, 0)
        wait_for(lambda: "written" in states("colornet"))
        consumer.take()

        hang.touch()
        begun, number = time.monotonic(), 1
        accept(service, journal, number)
        red_s = wait_for(lambda: light() == "red")
        while time.monotonic() - begun < HUNG_S:
            number += 1
            accept(service, journal, number)
            time.sleep(0.2)
        wait_for(lambda: states("archive").count("written") == number + 1)
        while_hung = states("colornet").count("pending")

        hang.unlink()
        left = {"pending", "publishing"}
        drained_s = wait_for(lambda: left.isdisjoint(states("colornet")))
        consumer.take()

        assert len(states("colornet")) == number + 1
        assert list(journal.trail.faults()) == []
    print(  # noqa: T201
        f"red after {red_s:.1f} s; {number} readings accepted in {HUNG_S:g} s, "
        f"{while_hung} of them drained in {drained_s:.1f} s"
    )
    assert while_hung >= number - 32  # those that were under way are publishing
    assert (len(consumer.seen), consumer.doubled(), consumer.torn) == (
        number + 1,
        [],
        [],
    )
    assert drained_s <= 10.0


def accept(service: Service, journal: Journal, number: int) -> None:
    journal.accept_reading(reading(number), source="bench")
    service.wake()
