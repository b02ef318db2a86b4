"""Floods, readers that poll, and clocks that jump (P4, P9, P11)."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import threading
import time
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from paintlink.daemon.journal import Journal
from paintlink.export import publish, stage
from tests.daemon.conftest import make_reading
from tests.daemon.test_line import Shop
from tests.proofs.tracing import needs_tracing, traced

pytestmark = pytest.mark.timeout(600)


def content(number: int) -> bytes:
    return b"<reading>%d</reading>" % number * 50


def deliver(folder: Path, first: int, last: int) -> None:
    for number in range(first, last):
        data = content(number)
        digest = hashlib.sha256(data).hexdigest()
        stage(folder, f"t-{number}", data)
        publish(folder, f"t-{number}", f"{number}-{digest}.xml")


@needs_tracing
@pytest.mark.proof
def test_reader_that_polls_sees_whole_files_only(tmp_path: Path) -> None:
    hot = tmp_path / "hot"
    hot.mkdir()
    seen, torn, strange = set(), [], []
    stop = threading.Event()

    def poll() -> None:
        while not stop.is_set():
            for name in set(os.listdir(hot)) - seen:  # noqa: PTH208
                if name.endswith(".xml"):
                    seen.add(name)
                    data = (hot / name).read_bytes()
                    if hashlib.sha256(data).hexdigest() not in name:
                        torn.append(name)
                elif name != ".paintlink":
                    strange.append(name)
            stop.wait(0.001)

    reader = threading.Thread(target=poll)
    reader.start()
    for start in range(0, 2000, 20):
        kill = 40 + start % 97 if start % 100 == 0 else None
        run = traced(lambda: deliver(hot, start, start + 20), kill_at=kill)  # noqa: B023
        if run.status is None:
            done = len(list(hot.glob("*.xml"))) - start
            deliver(hot, start + max(done, 0), start + 20)
    stop.set()
    reader.join()

    assert len(seen) == 2000
    assert (torn, strange) == ([], [])


@pytest.mark.proof
def test_flood_of_one_device_starves_no_other(tmp_path: Path) -> None:
    """20 000 readings as fast as they can be stored, and another device beside."""
    path = tmp_path / "journal.db"
    Journal(path).close()
    done = threading.Event()

    def flood() -> None:
        with Journal(path) as journal:
            for number in range(20_000):
                reading = make_reading(raw=b"flood %d" % number)
                journal.accept_reading(reading, source="stuck")
        done.set()

    thread = threading.Thread(target=flood)
    before = resident_kib()
    thread.start()
    waits, number, largest_log = [], 0, 0
    with Journal(path) as journal:
        while not done.wait(0.05):
            number += 1
            begun = time.perf_counter()
            reading = make_reading(raw=b"slow %d" % number)
            journal.accept_reading(reading, source="slow")
            waits.append(time.perf_counter() - begun)
            log = path.with_name("journal.db-wal")
            largest_log = max(largest_log, log.stat().st_size)
        counted = journal.counts()["received"]
    thread.join()

    grown = resident_kib() - before
    print(  # noqa: T201
        f"slow device p99 {np.quantile(waits, 0.99) * 1000:.0f} ms of {len(waits)}, "
        f"resident +{grown} KiB, log {largest_log >> 20} MiB"
    )
    assert counted == 20_000 + number
    assert largest_log < 64 << 20
    assert grown < 20 * 1024
    assert np.quantile(waits, 0.99) < 0.2


def resident_kib() -> int:
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * (os.sysconf("SC_PAGE_SIZE") // 1024)


JUMPS = {
    "back ten days": -10 * 86400.0,
    "on 400 days": 400 * 86400.0,
    "daylight saving": 3600.0,
    "and back": -3600.0,
    "leap second": -1.0,
    "year 2038": 2**31 - 1_800_000_000.0,
    "year 9999": datetime(9999, 12, 30, tzinfo=UTC).timestamp() - 1_800_000_000.0,
    "year 1970": 1.0 - 1_800_000_000.0,
}


@pytest.mark.parametrize("name", list(JUMPS))
def test_clock_jump_changes_neither_order_nor_names(tmp_path: Path, name: str) -> None:
    shop = Shop(tmp_path / "shop", "json")
    shop.now = 1_800_000_000.0
    moment = [datetime.fromtimestamp(shop.now, UTC)]
    shop.journal = Journal(shop.settings.journal_path, now=lambda: moment[0])
    shop.line = shop.new_line()
    names: list[str] = []
    for number in range(4):
        if number == 2:
            shop.now += JUMPS[name]
            moment[0] = datetime.fromtimestamp(shop.now, UTC)
        reading = replace(make_reading(raw=b"%d" % number), taken_at=moment[0])
        shop.journal.accept_reading(reading, source="bench")
        shop.drain()
        names += sorted(
            path.name for path in shop.files("json") if path.name not in names
        )

    jobs = shop.journal.jobs(newest_first=False)
    assert len(set(names)) == 4
    assert [one.deliveries[0].name for one in jobs] == names
    assert [job.state for job in jobs] == ["done"] * 4
    assert list(shop.journal.trail.faults()) == []


@pytest.mark.parametrize("name", ["back ten days", "on 400 days"])
def test_retry_after_a_clock_jump_comes_within_seconds(
    tmp_path: Path, name: str
) -> None:
    shop = Shop(tmp_path / "shop", "json")
    shop.now = 1_800_000_000.0
    shutil.rmtree(shop.folder / "json")
    shop.journal.accept_reading(make_reading(), source="bench")
    shop.drain()

    shop.now += JUMPS[name]
    (shop.folder / "json").mkdir()
    for _ in range(12):
        shop.now += 1.0
        shop.drain()

    assert len(shop.files("json")) == 1


@pytest.mark.skipif(
    shutil.which("faketime") is None, reason="faketime is not installed"
)
@pytest.mark.parametrize("shift", ["-3650d", "+400d", "+20y"])
def test_program_started_in_another_year_works(tmp_path: Path, shift: str) -> None:
    script = (
        "from pathlib import Path; import sys\n"
        "from paintlink.daemon.journal import Journal\n"
        "from tests.daemon.conftest import make_reading\n"
        "with Journal(Path(sys.argv[1])) as journal:\n"
        "    journal.accept_reading(make_reading(), source='bench')\n"
    )
    path = tmp_path / "journal.db"
    command = ["faketime", "-f", shift, sys.executable, "-c", script, str(path)]

    subprocess.run(command, check=True, cwd=Path(__file__).parents[2])
    subprocess.run(command[3:], check=True, cwd=Path(__file__).parents[2])

    with Journal(path) as journal:
        assert len(journal.jobs()) == 1
