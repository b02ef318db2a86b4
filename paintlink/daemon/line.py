"""The line: from a stored reading to files in other programs' folders.

Every step may be repeated; a crash between any two of them loses nothing and delivers
nothing twice.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping

from paintlink.config import Settings
from paintlink.daemon.deliverer import Deliverer
from paintlink.daemon.formulation import Booth
from paintlink.daemon.journal import Journal
from paintlink.daemon.pipeline import match, open_routes, specify
from paintlink.daemon.records import Job
from paintlink.errors import InputError
from paintlink.export import Format
from paintlink.model import PaintTable

log = logging.getLogger(__name__)


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
        self._booth = Booth(journal, settings.formulation, settings.answering_route)
        self._deliverer = Deliverer(
            journal, settings.routes, formats, clock=clock, without=others
        )

    def step(self) -> bool:
        """Do one piece of work; False when nothing is waiting."""
        return self._specify() or self._match() or self._deliverer.step()

    def look_at_folders(self) -> None:
        """Note which files the other programs have taken, and which lie too long."""
        self._deliverer.look_at_folders()

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
        root = self._booth.panel_of(job)
        if root is not None:
            self._booth.judge(job, root)
            return True
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

    def _fail(self, job: Job, error: InputError) -> None:
        log.warning("%s failed: %s", job.token, error)
        self._journal.fail(job, str(error))
