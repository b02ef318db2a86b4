"""How fast readings go through the whole line, and how soon a file can be seen.

Usage: python benchmarks/line.py [--seconds 20] [--waiting 100000] [--dir FOLDER]

The figures are ratios within one run: readings a second over the rate of bare commits
that SQLite syncs on the same disk, with nothing else to do. The bars are meant for
--seconds 600.
"""

from __future__ import annotations

import argparse
import os
import sqlite3
import tempfile
import threading
import time
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from paintlink.color import normalise
from paintlink.config import (
    InboxSettings,
    PreviewSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon.journal import Journal
from paintlink.daemon.service import Service
from paintlink.model import Geometry, Instrument, Measurement, Reading, Spectra
from paintlink.spec import write_spec

ANGLES = (15.0, 25.0, 45.0, 75.0, 110.0)
AHEAD = 200


def main() -> None:
    """Run the three measurements one after another."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--waiting", type=int, default=100_000)
    parser.add_argument("--dir", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.dir) as name:
        folder = Path(name)
        throughput(folder / "rate", options.seconds)
        latency(folder / "latency", min(options.seconds, 60.0))
        waiting(folder / "waiting", options.waiting)


def reading(number: int) -> Reading:
    """A reading of its own: no two of a run are the same."""
    level = 0.2 + 0.6 * (number % 997) / 997
    factors = np.linspace(1.0, 0.2, 5)[:, None] * level * np.linspace(0.8, 1.2, 31)
    measurement = Measurement(
        geometries=tuple(Geometry(angle) for angle in ANGLES),
        spectra=Spectra(np.arange(400.0, 701.0, 10.0), factors),
        raw=b"%d" % number,
        record=str(number),
    )
    instrument = Instrument("Bench", "B5", "1")
    return Reading(measurement, instrument, datetime.now(UTC), "real", sample="s")


def settings(folder: Path) -> Settings:
    """A shop with one route and no pictures."""
    (folder / "colornet").mkdir(parents=True)
    route = RouteSettings(name="c", folder=folder / "colornet", format="colornet")
    return Settings(
        site=SiteSettings(folder=folder),
        state=StateSettings(folder=folder / "state"),
        inbox=InboxSettings(folder=folder / "inbox"),
        routes=(route,),
        preview=PreviewSettings(enabled=False),
    )


def bare_commits(folder: Path, seconds: float) -> float:
    """Synced commits of one small row a second."""
    folder.mkdir(parents=True, exist_ok=True)
    with closing(sqlite3.connect(folder / "bare.db", isolation_level=None)) as db:
        db.execute("PRAGMA journal_mode=WAL")
        db.execute("PRAGMA synchronous=FULL")
        db.execute("CREATE TABLE IF NOT EXISTS t (x BLOB)")
        count, begun = 0, time.perf_counter()
        while time.perf_counter() - begun < seconds:
            db.execute("INSERT INTO t VALUES (?)", (b"x" * 500,))
            count += 1
        return count / (time.perf_counter() - begun)


def throughput(folder: Path, seconds: float) -> None:
    """Readings through the line, as fast as it takes them, over bare commits."""
    before = bare_commits(folder, min(5.0, seconds / 4))
    told = settings(folder / "site")
    service = Service(told, roles=("line",))
    service.start()
    accepted, taken, begun = 0, 0, time.perf_counter()
    resident = []
    with Journal(told.journal_path) as journal:
        while time.perf_counter() - begun < seconds:
            journal.accept_reading(reading(accepted), source="bench")
            accepted += 1
            if accepted % 50 == 0:
                service.wake()
                resident.append(resident_mib())
                taken += take(told)
                while accepted - taken > AHEAD:
                    time.sleep(0.005)
                    taken += take(told)
        while taken < accepted:
            time.sleep(0.01)
            taken += take(told)
    rate = accepted / (time.perf_counter() - begun)
    service.stop()
    bare = (before + bare_commits(folder, min(5.0, seconds / 4))) / 2
    print(
        f"line       {rate:7.0f} readings/s, bare commits {bare:7.0f}/s, ratio "
        f"{rate / bare:.2f} (bar 0.25), {seconds:g} s, resident "
        f"{resident[0]:.0f} to {resident[-1]:.0f} MiB"
    )


def take(told: Settings) -> int:
    """Files the program behind the route takes away, as it does in a shop."""
    files = [one for one in os.scandir(told.routes[0].folder) if one.is_file()]
    for one in files:
        Path(one).unlink()
    return len(files)


def delivered(told: Settings) -> int:
    """Files that can be seen in the folder of the route."""
    return sum(
        entry.name.endswith(".xml") for entry in os.scandir(told.routes[0].folder)
    )


def latency(folder: Path, seconds: float) -> None:
    """From a stored reading to a file that can be seen, at two readings a second."""
    told = settings(folder)
    service = Service(told, roles=("line",))
    service.start()
    waits = []
    with Journal(told.journal_path) as journal:
        for number in range(max(4, int(2 * seconds))):
            known = delivered(told)
            journal.accept_reading(reading(number), source="bench")
            acknowledged = time.perf_counter()
            service.wake()
            while delivered(told) == known:
                time.sleep(0.0005)
            waits.append(time.perf_counter() - acknowledged)
            time.sleep(max(0.0, 0.5 - waits[-1]))
    service.stop()
    p50, p99 = np.quantile(waits[1:], (0.5, 0.99)) * 1000.0
    print(f"latency    p50 {p50:.0f} ms (bar 60), p99 {p99:.0f} ms (bar 250)")


def waiting(folder: Path, files: int) -> None:
    """A hundred thousand files in the inbox when the service starts."""
    told = settings(folder)
    told = replace(told, inbox=replace(told.inbox, poll_s=1.0, quiet_s=1.0))
    inbox = folder / "inbox"
    inbox.mkdir()
    text = write_spec(normalise(reading(1), name="waiting", finish="metallic"))
    for number in range(files):
        content = text.replace(b"waiting", b"waiting %d" % number)
        (inbox / f"{number}.xml").write_bytes(content)
    service = Service(told)
    resident, begun = resident_mib(), time.perf_counter()
    service.start()
    while delivered(told) == 0:
        time.sleep(0.005)
    first_s = time.perf_counter() - begun
    time.sleep(5.0)
    grown = resident_mib() - resident
    service.stop()
    print(
        f"waiting    first of {files} delivered after {first_s:.2f} s (bar 3), "
        f"resident +{grown:.0f} MiB"
    )


def resident_mib() -> float:
    """Memory of this process."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


if __name__ == "__main__":
    threading.current_thread().name = "benchmark"
    main()
