"""One shop whose threads can be run one at a time, in a child, and killed anywhere."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import timedelta
from pathlib import Path

from lxml import etree

from paintlink.config import (
    FormulationSettings,
    InboxSettings,
    PreviewSettings,
    RouteSettings,
    Settings,
    SiteSettings,
    StateSettings,
)
from paintlink.daemon.deliverer import Deliverer
from paintlink.daemon.formulation import AnswerWorker
from paintlink.daemon.inbox import InboxWorker
from paintlink.daemon.journal import Journal
from paintlink.daemon.line import Line
from paintlink.export import load_formats
from paintlink.intake import Inbox, InboxFolders
from paintlink.library import bundled
from paintlink.model import Reading
from paintlink.spec import write_spec
from tests.daemon.conftest import NOON, make_reading, make_spec

READINGS = 3
FORMATS = load_formats()
TABLE = bundled()
SECONDS = 1_800_000_000.0


def reading(number: int) -> Reading:
    """One of the readings an instrument takes, always the same under its number."""
    made = make_reading(raw=b"raw bytes %d" % number)
    return replace(
        made, sample=f"panel {number}", taken_at=NOON + timedelta(seconds=number)
    )


@dataclass
class Consumer:
    """The other program: takes and deletes every file at once, and remembers."""

    folder: Path
    seen: Counter[str] = field(default_factory=Counter)
    torn: list[str] = field(default_factory=list)

    def take(self) -> None:
        for path in self.folder.glob("*.xml"):
            try:
                root = etree.fromstring(path.read_bytes())
            except etree.XMLSyntaxError:
                self.torn.append(path.name)
            else:
                self.seen[f"{root.get('id')}-{root.get('copy')}"] += 1
            path.unlink()

    def doubled(self) -> list[str]:
        return [name for name, times in self.seen.items() if times > 1]


class Stages:
    """Folders and settings of a shop; each stage is what one thread of it does."""

    def __init__(
        self, root: Path, *, hot: Path | None = None, state: Path | None = None
    ) -> None:
        self.root = root
        self.hot = hot or root / "hot"
        for folder in (self.hot, root / "acks"):
            folder.mkdir(parents=True, exist_ok=True)
        self.settings = Settings(
            site=SiteSettings(folder=root),
            state=StateSettings(folder=state or root / "state"),
            inbox=InboxSettings(folder=root / "inbox"),
            routes=(
                RouteSettings(name="colornet", folder=self.hot, format="colornet"),
            ),
            preview=PreviewSettings(enabled=False),
        )
        self.inboxes = {
            "inbox": InboxFolders.below(root),
            "answers": InboxFolders.below(root, root / "answers", within="answers"),
        }
        for folders in self.inboxes.values():
            folders.create()
        self.consumer = Consumer(self.hot)

    def journal(self) -> Journal:
        return Journal(self.settings.journal_path)

    def run(self, stage: str) -> None:
        """What one thread does until nothing is left to do."""
        with closing(self.journal()) as journal:
            step: Callable[[], bool] = getattr(self, f"_{stage}")(journal)
            while step():
                pass

    def work(self, stage: str) -> Callable[[], None]:
        return lambda: self.run(stage)

    def drop_files(self) -> None:
        for number in range(READINGS):
            path = self.root / "inbox" / f"{number}.xml"
            path.write_bytes(write_spec(make_spec(f"panel {number}")))

    def acknowledged(self) -> list[int]:
        return sorted(int(path.name) for path in (self.root / "acks").iterdir())

    def _intake(self, journal: Journal) -> Callable[[], bool]:
        """Readings in; each is acknowledged only when it has been accepted."""
        numbers = iter(range(READINGS))

        def step() -> bool:
            number = next(numbers, None)
            if number is None:
                return False
            journal.accept_reading(reading(number), source="bench")
            os.close(os.open(self.root / "acks" / str(number), os.O_CREAT, 0o600))
            return True

        return step

    def _inbox(self, journal: Journal) -> Callable[[], bool]:
        return InboxWorker(journal, self._settled_inbox("inbox")).step

    def _answers(self, journal: Journal) -> Callable[[], bool]:
        inbox = self._settled_inbox("answers")
        rules = FormulationSettings()
        return AnswerWorker(journal, inbox, rules, "colornet").step

    def _line(self, journal: Journal) -> Callable[[], bool]:
        line = Line(
            journal,
            self.settings,
            table=TABLE,
            formats=FORMATS,
            clock=lambda: SECONDS,
            others=("colornet",),
        )
        return line.step

    def _route(self, journal: Journal) -> Callable[[], bool]:
        deliverer = Deliverer(
            journal,
            self.settings.routes,
            FORMATS,
            clock=lambda: SECONDS,
            only="colornet",
        )
        return deliverer.step

    def _settled_inbox(self, name: str) -> Inbox:
        """An inbox for which every file has been quiet for long enough."""
        ticks = iter(range(10_000))
        inbox = Inbox(
            self.inboxes[name],
            quiet_s=1.0,
            max_bytes=1_000_000,
            clock=lambda: 10.0 * next(ticks),
        )
        inbox._look()
        return inbox


def warm_up(stages: Stages) -> None:
    """Import everything in this process, so that children open only what matters."""
    stages.drop_files()
    for stage in ("intake", "inbox", "line", "route", "answers"):
        stages.run(stage)


def points(count: int) -> Iterator[int]:
    yield from range(1, count + 1)
