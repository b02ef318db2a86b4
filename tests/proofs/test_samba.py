"""A real SMB share as the folder of a route: held open, gone, and back."""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.config import RouteSettings
from paintlink.daemon.journal import Journal
from paintlink.daemon.service import Service
from tests.daemon.test_line import Shop
from tests.proofs.samba import Samba, mounted, samba
from tests.proofs.stages import reading

# The server knows no port but the usual one.
pytestmark = [
    pytest.mark.proof,
    pytest.mark.timeout(300),
    pytest.mark.xdist_group("samba"),
]

LIMIT_S = 60.0


def wait_for(condition: Callable[[], bool]) -> float:
    """Seconds until the condition came true."""
    begun = time.monotonic()
    while not condition():
        if time.monotonic() - begun > LIMIT_S:
            pytest.fail("waited for a minute")
        time.sleep(0.05)
    return time.monotonic() - begun


def held_open(name: str) -> subprocess.Popen[str]:
    """The other program with a file open."""
    held = subprocess.Popen(
        ["smbclient", "-N", "//127.0.0.1/hot"],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    )
    assert held.stdin is not None
    held.stdin.write(f"open {name}\n")
    held.stdin.flush()
    return held


def taken(server: Samba) -> list[str]:
    """Names the other program found, all fetched and deleted over SMB."""
    names = [path.name for path in server.share.glob("*.xml")]
    for name in names:
        server.run(f'get "{name}" /dev/null; del "{name}"')
    return names


def test_share_held_open_gone_and_back_loses_nothing(tmp_path: Path) -> None:
    with samba(tmp_path / "samba") as server, mounted(tmp_path / "client") as folder:
        server.share.joinpath(".paintlink-share").touch()
        shop = Shop(tmp_path / "shop")
        route = RouteSettings(
            name="colornet", folder=folder, format="colornet", share=True
        )
        service = Service(replace(shop.settings, routes=(route,)), roles=("line",))
        service.start()
        journal = Journal(shop.settings.journal_path)
        try:
            seen = rounds(server, service, journal)
        finally:
            service.stop()
            journal.close()

    assert len(seen) == len(set(seen)) == 40


def written(journal: Journal) -> int:
    return sum(
        one.state in {"written", "taken"}
        for job in journal.jobs(limit=99)
        for one in job.deliveries
    )


def accept(service: Service, journal: Journal, first: int, last: int) -> None:
    for number in range(first, last):
        journal.accept_reading(reading(number), source="bench")
    service.wake()


def rounds(server: Samba, service: Service, journal: Journal) -> list[str]:
    accept(service, journal, 0, 10)
    wait_for(lambda: written(journal) == 10)
    holder = held_open(next(server.share.glob("*.xml")).name)
    accept(service, journal, 10, 20)
    wait_for(lambda: written(journal) == 20)
    with holder:
        holder.terminate()
    seen = taken(server)

    server.stop()
    accept(service, journal, 20, 40)
    wait_for(lambda: any(one.state == "pending" and one.error
                         for job in journal.jobs(limit=99)
                         for one in job.deliveries))  # fmt: skip
    while_away = written(journal)
    server.start()
    drained_s = wait_for(lambda: written(journal) == 40)

    print(f"backlog of {40 - while_away} drained in {drained_s:.1f} s")  # noqa: T201
    assert drained_s <= 10.0
    return seen + taken(server)
