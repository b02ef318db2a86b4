"""A worker at simulated instruments on real pseudo-terminals."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from paintlink.config import InstrumentSettings
from paintlink.daemon.instruments import InstrumentWorker
from paintlink.daemon.journal import Journal
from paintlink.daemon.records import InstrumentStatus
from paintlink.daemon.scanner import Scanner
from paintlink.instrument import modules_in_group
from paintlink.model import Reading
from paintlink_simulators import Panel, PtyPort

PATIENCE_S = 20.0


def panel() -> Panel:
    """A grey that every instrument can measure."""
    angles = np.array([15.0, 25.0, 45.0, 75.0, 110.0])
    level = np.array([0.8, 0.7, 0.5, 0.3, 0.2])[:, None]
    return Panel(angles, level * np.linspace(0.9, 1.1, 31), "grey")


def simulator_module(driver: str) -> Any:
    return modules_in_group("paintlink.simulators").found[driver]


def simulator(driver: str, seed: int = 1, speed: float = 1.0, **options: Any) -> Any:
    """An instrument that works ``speed`` times as fast as a real one."""
    module = simulator_module(driver)
    return module.create(
        panel(), clock=lambda: speed * time.monotonic(), seed=seed, **options
    )


class Desk:
    """A journal, a stop event and workers that are ended with the test."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.journal_path = folder / "journal.db"
        self.journal = Journal(self.journal_path)
        self.stop = threading.Event()
        self.threads: list[threading.Thread] = []
        self.ports: list[PtyPort] = []

    def plug(self, driver: str, name: str = "", **options: Any) -> PtyPort:
        link = self.folder / name if name else None
        press_s = options.pop("press_s", None)
        port = PtyPort(
            simulator(driver, **options), link=link, auto_press_after_s=press_s
        )
        self.ports.append(port)
        return port

    def work(self, driver: str, port: str, **keywords: Any) -> InstrumentWorker:
        settings = {
            "name": keywords.pop("name", "bench"),
            "driver": driver,
            "port": port,
            "readings": 1,
            **keywords.pop("settings", {}),
        }
        worker = InstrumentWorker(
            InstrumentSettings(**settings),
            self.journal_path,
            stop=self.stop,
            **{"wake_line": lambda: None, **keywords},
        )
        scanner = Scanner([port], [worker.wake], stop=self.stop)
        for thread in (worker, scanner):
            self.threads.append(thread)
            thread.start()
        return worker

    def status(self, name: str = "bench") -> InstrumentStatus:
        return next(one for one in self.journal.instruments() if one.name == name)

    def until(self, true: Callable[[], bool], what: str = "it") -> float:
        """Seconds until something became true."""
        start = time.monotonic()
        while not (self.journal.instruments() and true()):
            assert time.monotonic() - start < PATIENCE_S, f"{what}: {self.statuses()}"
            self.stop.wait(0.02)
        return time.monotonic() - start

    def until_state(self, state: str, name: str = "bench") -> float:
        return self.until(lambda: self.status(name).state == state, state)

    def count(self) -> int:
        """Stored readings."""
        return sum(self.journal.counts().values())

    def statuses(self) -> list[tuple[str, str, str]]:
        return [(one.name, one.state, one.text) for one in self.journal.instruments()]

    def readings(self) -> list[Reading]:
        jobs = self.journal.jobs(limit=100_000, newest_first=False)
        return [self.journal.reading(one.reading_id) for one in jobs if one.reading_id]

    def close(self) -> None:
        self.stop.set()
        for thread in self.threads:
            thread.join(10.0)
        for port in self.ports:
            port.close()
        self.journal.close()
