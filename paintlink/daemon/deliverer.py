"""Files into the folders of other programs, and what became of them there."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from pathlib import Path

from paintlink.config import RouteSettings
from paintlink.daemon.deliveries import FARTHEST_RETRY_S
from paintlink.daemon.faults import Batch
from paintlink.daemon.journal import Journal
from paintlink.daemon.pipeline import retry_delay_s
from paintlink.daemon.records import Delivery, Job
from paintlink.errors import ExportError
from paintlink.export import (
    ExportFile,
    Format,
    JobFacts,
    discard,
    outcome,
    publish,
    publish_many,
    render,
    require_share,
    stage_many,
)

log = logging.getLogger(__name__)

BEYOND_REPEATING = {"exists", "name", "format", "starting-paint"}
LOOK_AGAIN_S = 5.0
TOGETHER = 32


def staged_name(job: Job, delivery: Delivery) -> str:
    """Name of the staged file: unique to this delivery among all installations."""
    return f"{job.token}-{delivery.id}"


class Deliverer:
    """Works on the deliveries of some routes, one durable step at a time.

    Parameters
    ----------
    routes
        The routes of the configuration.
    formats
        Export formats by id.
    clock
        Seconds since 1970; retry times are kept in the journal and outlive a restart.
    only
        The route to serve; None serves all.
    without
        Routes that others serve.
    threads
        How many files to sync at once.
    """

    def __init__(
        self,
        journal: Journal,
        routes: Sequence[RouteSettings],
        formats: Mapping[str, Format],
        *,
        clock: Callable[[], float],
        only: str | None = None,
        without: Sequence[str] = (),
        threads: int = 1,
    ) -> None:
        self._threads = threads
        self._batch = Batch(TOGETHER)
        self._journal = journal
        self._routes = {route.name: route for route in routes}
        # Nobody else's: looking at a share that hangs would hang this route, too.
        self._own = [
            route
            for route in routes
            if only in {None, route.name} and route.name not in without
        ]
        self._formats = formats
        self._clock = clock
        self._only = only
        self._without = without
        self._resting_until: dict[str, float] = {}
        self._seen: tuple[int, ...] = ()
        self._looked_at = float("-inf")

    def step(self) -> bool:
        """Take some deliveries further, in one go; False when none is due."""
        now = self._clock()
        resting = [
            name
            for name, at in self._resting_until.items()
            if now < at <= now + FARTHEST_RETRY_S
        ]
        due = self._journal.deliveries.due_together(
            now,
            self._batch.size,
            route=self._only,
            without=[*self._without, *resting],
        )
        if not due:
            return False
        taken = due if due[0].state == "pending" else due[:1]
        what = f"route {due[0].route}, delivery {due[0].id}"
        with self._batch.tried(taken, what, partial(self._put_aside, due[0])):
            self._serve(taken)
        return True

    def _serve(self, due: Sequence[Delivery]) -> None:
        try:
            self._require_folder(due[0])
            if due[0].state == "pending":
                self._deliver(due)
            else:
                self._continue(due[0])
        except ExportError as error:
            self._not_delivered(due[0], error)
        else:
            self._resting_until.pop(due[0].route, None)

    def _put_aside(self, delivery: Delivery, fault: str) -> None:
        """Leave a delivery to people, unless it got further before the fault."""
        if self._journal.deliveries.state_of(delivery.id) != delivery.state:
            return
        if delivery.state == "publishing":
            note = f"{fault}: look whether {delivery.name} arrived"
            self._journal.deliveries.settle(delivery, "unknown", note)
            return
        note = f"{fault}; report it; `paintlink jobs retry` tries it again"
        self._journal.deliveries.settle(delivery, "failed", note)

    def look_at_folders(self) -> None:
        """Note which files the other programs have taken, and which lie too long."""
        if not self._is_worth_a_look():
            return
        lying: dict[tuple[str, str], list[Delivery]] = {}
        for one in self._journal.deliveries.lying(self._only):
            if one.route not in self._without:
                lying.setdefault((one.route, one.folder), []).append(one)
        for (route, folder), deliveries in lying.items():
            self._look(self._routes.get(route), Path(folder), deliveries)

    def _is_worth_a_look(self) -> bool:
        """Whether a folder has changed, or nobody has looked for a while."""
        now, seen = self._clock(), tuple(map(_changed_at, self._own))
        if seen == self._seen and abs(now - self._looked_at) < LOOK_AGAIN_S:
            return False
        self._seen, self._looked_at = seen, now
        return True

    def _look(
        self, route: RouteSettings | None, folder: Path, deliveries: list[Delivery]
    ) -> None:
        try:
            if route is not None and route.share:
                require_share(folder)
            names = {entry.name for entry in os.scandir(folder)}
        except (OSError, ExportError):
            return  # a folder that is away says nothing about its files
        for one in deliveries:
            if one.name not in names:
                self._journal.deliveries.settle(one, "taken", one.name)
            elif one.state == "written":
                self._notice_stale(one, route)

    def _notice_stale(self, delivery: Delivery, route: RouteSettings | None) -> None:
        written = datetime.fromisoformat(delivery.written_at).timestamp()
        if route is None or self._clock() - written < route.stale_min * 60.0:
            return
        note = (
            f"not taken for {route.stale_min:g} minutes: is the other program running?"
        )
        self._journal.deliveries.settle(delivery, "stale", note)
        log.warning("%s %s: %s", delivery.route, delivery.name, note)

    def _require_folder(self, delivery: Delivery) -> None:
        route = self._routes.get(delivery.route)
        if route is not None and route.share:
            require_share(Path(delivery.folder))

    def _deliver(self, due: Sequence[Delivery]) -> None:
        """Stage, mark, publish and mark again: one sync of each kind for all."""
        files = self._rendered(due)
        if not files:
            return
        folder, route = Path(due[0].folder), self._route(due[0])
        data = {token: file.data for token, (_, file) in files.items()}
        stage_many(folder, data, mode=route.mode_bits, threads=self._threads)
        with self._journal.transaction():
            staged = {
                token: self._journal.deliveries.set_publishing(
                    delivery, file.name, file.sha256
                )
                for token, (delivery, file) in files.items()
            }
        refused = publish_many(folder, {k: one.name for k, one in staged.items()})
        with self._journal.transaction():
            for token, delivery in staged.items():
                if token not in refused:
                    self._written(delivery)
        for token, error in refused.items():
            self._not_delivered(staged[token], error)

    def _rendered(
        self, due: Sequence[Delivery]
    ) -> dict[str, tuple[Delivery, ExportFile]]:
        """The files by token; a job that cannot become one fails by itself."""
        files = {}
        for delivery in due:
            job = self._journal.head(delivery.job_id)
            try:
                file = self._render(self._route(delivery), job, delivery.copy)
            except ExportError as error:
                self._not_delivered(delivery, error)
            else:
                files[staged_name(job, delivery)] = (delivery, file)
        return files

    def _continue(self, delivery: Delivery) -> None:
        """Find out what became of an interrupted delivery, and finish it."""
        folder, token = Path(delivery.folder), self._token(delivery)
        state = outcome(folder, token)
        if state == "unknown":
            note = f"{folder}/.paintlink is gone: look whether {delivery.name} arrived"
            self._journal.deliveries.settle(delivery, "unknown", note)
            return
        if state == "staged":
            publish(folder, token, delivery.name)
        self._written(delivery)

    def _written(self, delivery: Delivery) -> None:
        self._journal.deliveries.settle(delivery, "written", delivery.name)
        log.info("%s wrote %s", delivery.route, delivery.name)

    def _token(self, delivery: Delivery) -> str:
        return staged_name(self._journal.head(delivery.job_id), delivery)

    def _render(self, route: RouteSettings, job: Job, copy: int) -> ExportFile:
        if job.spec is None or route.format not in self._formats:
            msg = (
                f"route {route.name}: no export format {route.format}; "
                f"there are {', '.join(sorted(self._formats))}"
            )
            raise ExportError(msg, kind="format")
        chosen = self._formats[route.format]
        if route.pattern is not None:
            chosen = replace(chosen, name_pattern=route.pattern)
        created = datetime.fromisoformat(job.created_at)
        panels = self._journal.formulas.panels(job.id)
        facts = JobFacts(job.token, created, job.origin, copy, panels)
        return render(job.spec, chosen, job=facts, document=job.document)

    def _not_delivered(self, delivery: Delivery, error: ExportError) -> None:
        """Try again what a repaired folder cures; ask a person about the rest."""
        token = self._token(delivery)
        log.warning("%s %s: %s", token, delivery.route, error)
        if error.kind in BEYOND_REPEATING:
            discard(Path(delivery.folder), token)
            self._journal.deliveries.settle(delivery, "failed", str(error))
            return
        retry_at = self._clock() + retry_delay_s(delivery.attempts)
        self._journal.deliveries.postpone(delivery, retry_at, str(error))
        # The next one would meet the same folder; one that gets through wakes all.
        self._resting_until[delivery.route] = retry_at

    def _route(self, delivery: Delivery) -> RouteSettings:
        if delivery.route in self._routes:
            return self._routes[delivery.route]
        msg = (
            f"route {delivery.route} is no longer in the configuration: "
            "put it back, or close the delivery with `paintlink jobs close`"
        )
        raise ExportError(msg)


def _changed_at(route: RouteSettings) -> int:
    try:
        return route.folder.stat().st_mtime_ns
    except OSError:
        return -1
