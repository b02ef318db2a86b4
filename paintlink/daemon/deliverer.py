"""Files into the folders of other programs, and what became of them there."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from paintlink.config import RouteSettings
from paintlink.daemon.deliveries import FARTHEST_RETRY_S
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
    render,
    require_share,
    stage,
)

log = logging.getLogger(__name__)

BEYOND_REPEATING = {"exists", "name", "format", "starting-paint"}
LOOK_AGAIN_S = 5.0


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
    ) -> None:
        self._journal = journal
        self._routes = {route.name: route for route in routes}
        self._formats = formats
        self._clock = clock
        self._only = only
        self._without = without
        self._resting_until: dict[str, float] = {}
        self._seen: tuple[int, ...] = ()
        self._looked_at = float("-inf")

    def step(self) -> bool:
        """Take one delivery further; False when none is due."""
        now = self._clock()
        resting = [
            name
            for name, at in self._resting_until.items()
            if now < at <= now + FARTHEST_RETRY_S
        ]
        delivery = self._journal.deliveries.due(
            now, route=self._only, without=[*self._without, *resting]
        )
        if delivery is None:
            return False
        job = self._journal.job_by_id(delivery.job_id)
        try:
            self._require_folder(delivery)
            if delivery.state == "pending":
                delivery = self._stage(delivery, job)
            self._publish(delivery, staged_name(job, delivery))
        except ExportError as error:
            log.warning("%s %s: %s", job.token, delivery.route, error)
            self._not_delivered(delivery, job, error)
        else:
            self._resting_until.pop(delivery.route, None)
        return True

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
        now, seen = self._clock(), tuple(map(_changed_at, self._routes.values()))
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
        panels = self._journal.formulas.panels(job.id)
        facts = JobFacts(job.token, created, job.origin, copy, panels)
        return render(job.spec, chosen, job=facts)

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
