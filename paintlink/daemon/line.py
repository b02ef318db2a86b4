"""The line: from a stored reading to files in other programs' folders.

Every step may be repeated; a crash between any two of them loses nothing and delivers
nothing twice.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from paintlink.config import RouteSettings, Settings
from paintlink.daemon.journal import Journal
from paintlink.daemon.pipeline import match, open_routes, retry_delay_s, specify
from paintlink.daemon.records import Delivery, Job
from paintlink.errors import ExportError, InputError
from paintlink.export import (
    ExportFile,
    Format,
    JobFacts,
    discard,
    outcome,
    publish,
    render,
    stage,
)
from paintlink.model import PaintTable

log = logging.getLogger(__name__)

BEYOND_REPEATING = {"exists", "name", "format", "starting-paint"}


def staged_name(job: Job, delivery: Delivery) -> str:
    """Name of the staged file: unique to this delivery among all installations."""
    return f"{job.token}-{delivery.id}"


class Line:
    """Works on the oldest waiting thing first, one durable step at a time.

    Parameters
    ----------
    clock
        Seconds since 1970; retry times are kept in the journal and outlive a restart.
    """

    def __init__(
        self,
        journal: Journal,
        settings: Settings,
        *,
        table: PaintTable,
        formats: Mapping[str, Format],
        clock: Callable[[], float],
    ) -> None:
        self._journal = journal
        self._settings = settings
        self._table = table
        self._formats = formats
        self._clock = clock

    def step(self) -> bool:
        """Do one piece of work; False when nothing is waiting."""
        return self._specify() or self._match() or self._deliver()

    def look_at_folders(self) -> None:
        """Note which files the other programs have taken, and which lie too long."""
        limits_s = {one.name: one.stale_min * 60.0 for one in self._settings.routes}
        for delivery in self._journal.deliveries.lying():
            folder = Path(delivery.folder)
            if folder.is_dir() and not (folder / delivery.name).exists():
                self._journal.deliveries.settle(delivery, "taken", delivery.name)
            elif delivery.state == "written":
                self._notice_stale(delivery, limits_s.get(delivery.route))

    def _notice_stale(self, delivery: Delivery, limit_s: float | None) -> None:
        written = datetime.fromisoformat(delivery.written_at).timestamp()
        if limit_s is None or self._clock() - written < limit_s:
            return
        note = f"not taken for {limit_s / 60:g} minutes: is the other program running?"
        self._journal.deliveries.settle(delivery, "stale", note)
        log.warning("%s %s: %s", delivery.route, delivery.name, note)

    def _specify(self) -> bool:
        job = self._journal.waiting("received")
        if job is None:
            return False
        if job.reading_id is None:
            self._journal.fail(job, "the journal holds no reading for this job")
            return True
        try:
            spec = specify(self._journal.reading(job.reading_id))
            self._journal.set_specified(job, spec)
        except InputError as error:
            self._fail(job, error)
        return True

    def _match(self) -> bool:
        job = self._journal.waiting("specified")
        if job is None or job.spec is None:
            return False
        try:
            spec, matches = match(job.spec, self._table, self._settings.snap)
        except InputError as error:
            self._fail(job, error)
            return True
        routes = open_routes(self._settings.routes, job.origin)
        self._journal.set_matched(
            job, spec, matches, [(route.name, str(route.folder)) for route in routes]
        )
        if self._settings.preview.enabled:
            self._journal.request_preview(job)
        if not routes:
            self._journal.finish(job, f"no route accepts {job.origin} readings")
        log.info("%s nearest %s", job.token, matches[0].code)
        return True

    def _deliver(self) -> bool:
        delivery = self._journal.deliveries.due(self._clock())
        if delivery is None:
            return False
        job = self._journal.job_by_id(delivery.job_id)
        try:
            if delivery.state == "pending":
                delivery = self._stage(delivery, job)
            self._publish(delivery, staged_name(job, delivery))
        except ExportError as error:
            log.warning("%s %s: %s", job.token, delivery.route, error)
            self._not_delivered(delivery, job, error)
            return True
        if self._journal.deliveries.unfinished(job) == 0:
            self._journal.finish(job, "every route served")
        return True

    def _stage(self, delivery: Delivery, job: Job) -> Delivery:
        route = self._route(delivery)
        file = self._render(route, job, delivery.copy)
        stage(
            Path(delivery.folder),
            staged_name(job, delivery),
            file.data,
            mode=route.mode_bits,
        )
        return self._journal.deliveries.set_publishing(delivery, file.name, file.sha256)

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
        return render(
            job.spec, chosen, job=JobFacts(job.token, created, job.origin, copy)
        )

    def _publish(self, delivery: Delivery, token: str) -> None:
        folder = Path(delivery.folder)
        state = outcome(folder, token)
        if state == "unknown":
            note = f"{folder}/.paintlink is gone: look whether {delivery.name} arrived"
            self._journal.deliveries.settle(delivery, "unknown", note)
            return
        if state == "staged":
            publish(folder, token, delivery.name)
        self._journal.deliveries.settle(delivery, "written", delivery.name)
        log.info("%s wrote %s", delivery.route, delivery.name)

    def _not_delivered(self, delivery: Delivery, job: Job, error: ExportError) -> None:
        """Try again what a repaired folder cures; ask a person about the rest."""
        if error.kind in BEYOND_REPEATING:
            discard(Path(delivery.folder), staged_name(job, delivery))
            self._journal.deliveries.settle(delivery, "failed", str(error))
            return
        retry_at = self._clock() + retry_delay_s(delivery.attempts)
        self._journal.deliveries.postpone(delivery, retry_at, str(error))

    def _route(self, delivery: Delivery) -> RouteSettings:
        for route in self._settings.routes:
            if route.name == delivery.route:
                return route
        msg = (
            f"route {delivery.route} is no longer in the configuration: "
            "put it back, or close the delivery with `paintlink jobs`"
        )
        raise ExportError(msg)

    def _fail(self, job: Job, error: InputError) -> None:
        log.warning("%s failed: %s", job.token, error)
        self._journal.fail(job, str(error))
