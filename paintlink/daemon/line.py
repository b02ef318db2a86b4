"""The line: from a stored reading to files in other programs' folders.

Every step may be repeated; a crash between any two of them loses nothing and delivers
nothing twice.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from paintlink.config import Settings
from paintlink.daemon.averaging import average
from paintlink.daemon.deliverer import Deliverer
from paintlink.daemon.faults import Batch
from paintlink.daemon.formulation import Booth
from paintlink.daemon.journal import Journal
from paintlink.daemon.orders import StoredOrder, machine_verdict
from paintlink.daemon.pipeline import match, open_routes, specify
from paintlink.daemon.records import Job
from paintlink.daemon.specs import stored
from paintlink.errors import InputError, ReadingError
from paintlink.export import Format
from paintlink.model import ColorSpec, Match, PaintTable

log = logging.getLogger(__name__)

TOGETHER = 16

Change = Callable[[], object]


class Line:
    """Works on the oldest waiting thing first, one durable step at a time.

    Parameters
    ----------
    clock
        Seconds since 1970; retry times are kept in the journal and outlive a restart.
    others
        Routes that somebody else delivers to.
    """

    def __init__(
        self,
        journal: Journal,
        settings: Settings,
        *,
        table: PaintTable,
        formats: Mapping[str, Format],
        clock: Callable[[], float],
        others: tuple[str, ...] = (),
    ) -> None:
        self._journal = journal
        self._settings = settings
        self._table = table
        self._batch = Batch(TOGETHER)
        self._booth = Booth(journal, settings.formulation, settings.answering_route)
        self._deliverer = Deliverer(
            journal, settings.routes, formats, clock=clock, without=others
        )

    def step(self) -> bool:
        """Do one piece of work; False when nothing is waiting."""
        return self._advance() or self._deliverer.step()

    def look_at_folders(self) -> None:
        """Note which files the other programs have taken, and which lie too long."""
        self._deliverer.look_at_folders()

    def _advance(self) -> bool:
        """Take some jobs as far as their deliveries, with one sync for all.

        What takes time is done before the transaction begins: intake never waits.
        """
        jobs = self._journal.oldest(("received", "specified"), self._batch.size)
        if not jobs:
            return False
        first = jobs[0]
        with self._batch.tried(jobs, f"job {first}", partial(self._put_aside, first)):
            self._store([
                change
                for job_id in jobs
                for change in self._changes(self._journal.head(job_id))
            ])
        return True

    def _store(self, changes: Iterable[Change]) -> None:
        with self._journal.transaction():
            for change in changes:
                change()

    def _put_aside(self, job_id: int, fault: str) -> None:
        advice = "report it; `paintlink jobs retry` tries it again"
        self._journal.fail(job_id, f"{fault}; {advice}")

    def _changes(self, job: Job) -> Iterator[Change]:
        """What is to be stored for a job, in this order."""
        begun, keep = job.state, True
        try:
            if begun == "received":
                job = replace(job, spec=self._specified(job))
            matched = tuple(self._matched(job))
            keep = self._booth.panel_of(job) is not None
        except InputError as error:
            matched = (partial(self._fail, job, error),)
        if begun == "received" and job.spec is not None:
            # A specification that is stored again with its matches is only noted.
            yield partial(self._journal.set_specified, job, job.spec, keep=keep)
        yield from matched

    def _specified(self, job: Job) -> ColorSpec:
        if job.reading_id is None:
            msg = "the journal holds no reading for this job"
            raise ReadingError(msg)
        readings = self._journal.readings_of(job.id)
        if len(readings) < 2:
            return specify(self._journal.reading(job.reading_id))
        mean = average([one.measurement for one in readings])
        return specify(replace(readings[0], measurement=mean))

    def _matched(self, job: Job) -> Iterator[Change]:
        root = self._booth.panel_of(job)
        if root is not None:
            yield partial(self._booth.judge, job, root)
            return
        if job.spec is None:
            return
        spec, matches = match(job.spec, self._table, self._settings.snap)
        routes = open_routes(self._settings.routes, job.origin)
        order = self._journal.orders.of_job(job.order_id)
        if order is not None and order.template.routes:
            routes = [one for one in routes if one.name in order.template.routes]
        folders = [(route.name, str(route.folder)) for route in routes]
        stored(spec)  # spelled out now, or intake waits for it in the transaction
        yield partial(self._journal.set_matched, job, spec, matches, folders)
        if order is not None:
            yield from self._judged(job, order, matches)
        if self._settings.preview.enabled and (not order or order.template.preview):
            yield partial(self._journal.request_preview, job)
        if not routes:
            why = f"no route accepts {job.origin} readings"
            yield partial(self._journal.finish, job, why)
        log.info("%s nearest %s", job.token, matches[0].code)

    def _judged(
        self, job: Job, order: StoredOrder, matches: tuple[Match, ...]
    ) -> Iterator[Change]:
        """What the machine says of the paint that the order names, or the nearest."""
        named = [one for one in matches if one.code == order.order.paint_code]
        against = (named or list(matches))[0]
        verdict, angles = machine_verdict(against, order.template)
        yield partial(
            self._journal.orders.judge,
            job.id,
            "machine",
            verdict,
            angles=angles,
            note=f"against {against.code} by {against.formula}",
        )

    def _fail(self, job: Job, error: InputError) -> None:
        log.warning("%s failed: %s", job.token, error)
        self._journal.fail(job.id, str(error))
