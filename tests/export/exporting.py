"""The exporter run under strace, with a consumer that snatches what it publishes."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from tests.export.exporter import READINGS, content, export

EXPORTER = Path(__file__).with_name("exporter.py")
INTERPRETER = Path(sys.executable).resolve()  # strace would count a wrapper's calls
ENVIRONMENT = {
    "PATH": os.environ["PATH"],
    "PYTHONDONTWRITEBYTECODE": "1",
    "PYTHONHASHSEED": "0",
    "PYTHONPATH": os.pathsep.join(path for path in sys.path if path),
}


@dataclass
class Consumer:
    """The other program: takes what it sees, and remembers."""

    folder: Path
    taken: Counter[int] = field(default_factory=Counter)
    torn: list[str] = field(default_factory=list)

    def take(self) -> None:
        for path in sorted(self.folder.glob("*.xml")):
            reading = int(path.stem)
            if path.read_bytes() != content(reading):
                self.torn.append(path.name)
            path.unlink()
            self.taken[reading] += 1

    def lost(self) -> list[int]:
        return [reading for reading in READINGS if self.taken[reading] == 0]

    def doubled(self) -> list[int]:
        return [reading for reading in READINGS if self.taken[reading] > 1]


@dataclass
class Place:
    """A watched folder, a journal beside it, and a consumer."""

    root: Path
    protocol: str = "token"
    folder: Path | None = None

    def __post_init__(self) -> None:
        self.root.mkdir(parents=True)
        if self.folder is None:
            self.folder = self.root / "hot"
            self.folder.mkdir()
        self.consumer = Consumer(self.folder)

    def work(self) -> None:
        """What the exporter does, in this process."""
        assert self.folder is not None
        export(self.protocol, self.folder, self.root / "journal.db")

    def command(self, *tracer: str) -> list[str]:
        exporter = [str(INTERPRETER), str(EXPORTER), self.protocol]
        return [*tracer, *exporter, str(self.folder), str(self.root / "journal.db")]

    def export(self, *tracer: str) -> int:
        """Exit status of one run of the exporter, the consumer taking meanwhile."""
        with subprocess.Popen(self.command(*tracer), env=ENVIRONMENT) as process:
            while True:
                try:
                    status = process.wait(0.001)
                except subprocess.TimeoutExpired:
                    self.consumer.take()
                else:
                    self.consumer.take()
                    return status

    def export_unwatched(self, *tracer: str) -> int:
        """Exit status of one run of the exporter; everything stays in the folder."""
        run = subprocess.run(self.command(*tracer), env=ENVIRONMENT, check=False)
        return run.returncode


def traced(calls: str, *injections: str, log: str = "/dev/null") -> list[str]:
    options = [option for one in injections for option in ("-e", f"inject={one}")]
    return ["strace", "-f", "-y", "-qq", "-o", log, f"-etrace={calls}", *options]


def number_of_calls(call: str, root: Path, protocol: str) -> int:
    log = root / "calls"
    Place(root, protocol).export(*traced(call, log=str(log)))
    return sum(f" {call}(" in line for line in log.read_text().splitlines())


def calls_of_the_work(call: str, root: Path, protocol: str = "token") -> range:
    """Which uses of a system call are the exporter's own, after Python has started."""
    before = number_of_calls(call, root / "idle", "idle")
    return range(before + 1, number_of_calls(call, root / "clean", protocol) + 1)
