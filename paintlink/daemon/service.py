"""The service: instruments, inbox, line and pictures around one journal."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress

from paintlink.config import Settings, SinkSettings
from paintlink.daemon.database import utc_now
from paintlink.daemon.deliverer import Deliverer
from paintlink.daemon.drawings import Drawings
from paintlink.daemon.formulation import AnswerWorker
from paintlink.daemon.hints import Hints, Watcher
from paintlink.daemon.inbox import InboxWorker
from paintlink.daemon.instruments import InstrumentWorker, NameSample, default_sample
from paintlink.daemon.journal import Journal
from paintlink.daemon.keeping import clear_out
from paintlink.daemon.line import Line
from paintlink.daemon.order_worker import OrderWorker
from paintlink.daemon.paints import known_paints
from paintlink.daemon.render import Render
from paintlink.daemon.roles import ROLES, Role, RoleLocks
from paintlink.daemon.scanner import Scanner
from paintlink.daemon.sinks import SinkWorker
from paintlink.daemon.worker import Worker
from paintlink.export import load_formats
from paintlink.intake import Inbox, InboxFolders, load_profiles

log = logging.getLogger(__name__)

STOP_LIMIT_S = 5.0
STALL_S = 60.0
SHARE_POLL_S = 2.0
SETTLING_S = 0.25
SYNCED_AT_ONCE = 16
KEEPING_S = 3600.0
PATIENCE = 5.0  # quiet times that a file which cannot be read may still take


class Service:
    """Everything `paintlink run` runs, as threads of one process.

    Parameters
    ----------
    roles
        The parts to run here; other processes may run the others on the same state.
    readings
        Readings each instrument takes before it ends; None means no end.
    name_sample
        Name of the next sample, from the instrument's name.
    make_watcher
        Makes what tells of changes in folders; watchdog's observer when left out.
    """

    def __init__(
        self,
        settings: Settings,
        *,
        roles: Sequence[Role] = ROLES,
        readings: int | None = None,
        name_sample: NameSample = default_sample,
        make_watcher: Callable[[], Watcher] | None = None,
    ) -> None:
        self.settings = settings
        self.stopped = threading.Event()
        self._roles = tuple(dict.fromkeys(roles))
        self._line: Worker | None = None
        self._render: Worker | None = None
        self._deliverers: list[Worker] = []
        self._hints = Hints(make_watcher)
        self._workers: list[Worker] = []
        self._instruments = [
            InstrumentWorker(
                one,
                settings.journal_path,
                captures=settings.captures_folder,
                stop=self.stopped,
                wake_line=self._wake_line,
                name_sample=name_sample,
                limit=readings,
            )
            for one in (settings.instruments if "intake" in roles else ())
        ]

    def start(self) -> None:
        """Open the journal, take the roles and start every thread.

        Raises
        ------
        ConfigError
            When another process has one of the roles.
        JournalError
            When the journal cannot be used.
        """
        self._locks = RoleLocks(self.settings.state_folder, self._roles)
        Journal(self.settings.journal_path).close()
        makers: dict[Role, Callable[[], Worker]] = {
            "render": self._make_render,
            "line": self._make_line,
            "intake": self._make_intake,
        }
        for role in self._roles:
            if role != "intake" or self.settings.inbox.enabled:
                self._workers.append(makers[role]())
        for thread in (*self._workers, *self._instruments):
            thread.start()
        self._hints.start()
        if self._instruments:
            ports = [one.port for one in self.settings.instruments]
            wake = [one.wake for one in self._instruments]
            Scanner(ports, wake, stop=self.stopped).start()

    def stop(self) -> None:
        """End every thread; what is not finished is continued at the next start."""
        self.stopped.set()
        self._hints.stop()
        for worker in self._workers:
            worker.wake()
        deadline = time.monotonic() + STOP_LIMIT_S
        for thread in (*self._workers, *self._instruments):
            thread.join(max(0.0, deadline - time.monotonic()))
        self._locks.release()

    def wait_until_read(self, timeout_s: float) -> bool:
        """Whether every instrument took its readings within the time."""
        deadline = time.monotonic() + timeout_s
        for thread in self._instruments:
            thread.join(max(0.0, deadline - time.monotonic()))
        return all(thread.finished for thread in self._instruments)

    def wait_until_done(self, timeout_s: float) -> bool:
        """Whether line and pictures ran out of work within the time."""
        deadline = time.monotonic() + timeout_s
        return all(
            worker.idle.wait(max(0.0, deadline - time.monotonic()))
            for worker in (self._line, *self._deliverers, self._render)
            if worker is not None
        )

    def makes_progress(self) -> bool:
        """Whether every worker has come round within the last minute."""
        now = time.monotonic()
        return all(now - one.last_beat_s < STALL_S for one in self._workers)

    def wake(self) -> None:
        """Look for stored readings now."""
        self._wake_line()

    def _wake_line(self) -> None:
        if self._line is not None:
            self._line.wake()

    def _wake_all(self) -> None:
        for worker in (*self._deliverers, self._render):
            if worker is not None:
                worker.wake()

    def _make_line(self) -> Worker:
        served = tuple(route.name for route in self.settings.routes if route.enabled)
        table = known_paints(self.settings)

        def make_step() -> Callable[[], bool]:
            line = Line(
                Journal(self.settings.journal_path),
                self.settings,
                table=table,
                formats=load_formats(self.settings.formats_folder),
                clock=time.time,
                others=served,
            )

            def step() -> bool:
                worked = line.step()
                if worked:
                    self._wake_all()
                return worked

            return step

        self._line = Worker("line", make_step, stop=self.stopped, idle_s=1.0)
        self._deliverers = [self._make_deliverer(name) for name in served]
        self._workers += self._deliverers
        if self.settings.formulation.enabled:
            self._workers.append(self._make_answers())
        self._workers.append(self._make_orders())
        self._workers.append(self._make_keeping())
        self._workers += map(self._make_sink, self.settings.sinks)
        return self._line

    def _make_deliverer(self, route: str) -> Worker:
        """A thread of its own for each route: a hung share delays no other."""

        def make_step() -> Callable[[], bool]:
            deliverer = Deliverer(
                Journal(self.settings.journal_path),
                self.settings.routes,
                load_formats(self.settings.formats_folder),
                clock=time.time,
                only=route,
                threads=SYNCED_AT_ONCE,
            )

            def step() -> bool:
                worked = deliverer.step()
                if not worked:
                    deliverer.look_at_folders()
                return worked

            return step

        worker = Worker(f"route {route}", make_step, stop=self.stopped, idle_s=1.0)
        for one in self.settings.routes:
            if one.name == route and not one.share:
                self._hints.watch(one.folder, worker.wake)
        return worker

    def _make_sink(self, sink: SinkSettings) -> Worker:
        def make_step() -> Callable[[], bool]:
            return SinkWorker(Journal(self.settings.journal_path), sink, time.time).step

        return Worker(f"sink {sink.name}", make_step, stop=self.stopped, idle_s=1.0)

    def _make_answers(self) -> Worker:
        """Answers belong to the line: its program, its folder, its thread."""
        folder = self.settings.answers_folder
        folders = InboxFolders.below(
            self.settings.site_folder, folder, within="answers"
        )
        return self._make_watch(
            "answers",
            folders,
            lambda journal, inbox: (
                AnswerWorker(
                    journal,
                    inbox,
                    self.settings.formulation,
                    self.settings.answering_route,
                ).step
            ),
        )

    def _make_render(self) -> Worker:
        def make_step() -> Callable[[], bool]:
            journal = Journal(self.settings.journal_path)
            folder = self.settings.previews_folder
            return Render(journal, self.settings.preview, folder).step

        self._render = Worker("render", make_step, stop=self.stopped, idle_s=1.0)
        if self.settings.preview.enabled:
            self._workers.append(self._make_drawings())
        return self._render

    def _make_drawings(self) -> Worker:
        worker = Worker(
            "previews",
            lambda: Drawings(self.settings).step,
            stop=self.stopped,
            idle_s=1.0,
        )
        with suppress(OSError):  # it is made later, and looked into until then
            self.settings.drawings_folder.mkdir(parents=True, exist_ok=True)
        self._hints.watch(self.settings.drawings_folder, worker.wake)
        return worker

    def _make_keeping(self) -> Worker:
        days = self.settings.state.keep_days

        def make_step() -> Callable[[], bool]:
            keeping = Journal(self.settings.journal_path).keeping
            return lambda: clear_out(keeping, days, utc_now())

        return Worker("keeping", make_step, stop=self.stopped, idle_s=KEEPING_S)

    def _make_orders(self) -> Worker:
        folder = self.settings.orders_folder
        folders = InboxFolders.below(self.settings.site_folder, folder, within="jobs")
        return self._make_watch(
            "jobs",
            folders,
            lambda journal, inbox: (
                OrderWorker(journal, inbox, self.settings.templates).step
            ),
        )

    def _make_intake(self) -> Worker:
        profiles = load_profiles(self.settings.profiles_folder)
        rules = self.settings.inbox
        return self._make_watch(
            "inbox",
            InboxFolders.below(self.settings.site_folder, rules.folder),
            lambda journal, inbox: (
                InboxWorker(journal, inbox, finish=rules.finish, profiles=profiles).step
            ),
            share=rules.share,
        )

    def _make_watch(
        self,
        name: str,
        folders: InboxFolders,
        make: Callable[[Journal, Inbox], Callable[[], bool]],
        *,
        share: bool = False,
    ) -> Worker:
        """A thread that takes files from a folder."""
        rules = self.settings.inbox
        inbox = Inbox(
            folders,
            quiet_s=rules.quiet_s,
            max_bytes=rules.max_bytes,
            clock=time.monotonic,
            share=share,
            patience_s=PATIENCE * rules.quiet_s,
        )
        try:
            folders.create()
        except OSError as error:
            log.warning("%s; %s waits until it can be made", error, name)

        def make_step() -> Callable[[], bool]:
            take = make(Journal(self.settings.journal_path), inbox)

            def step() -> bool:
                worked = take()
                if worked:
                    self._wake_line()
                return worked

            return step

        def wait_s() -> float:
            poll_s = min(rules.poll_s, SHARE_POLL_S) if share else rules.poll_s
            return min(poll_s, SETTLING_S) if inbox.unsettled else poll_s

        worker = Worker(name, make_step, stop=self.stopped, idle_s=wait_s)
        self._hints.watch(folders.inbox, worker.wake)
        return worker
